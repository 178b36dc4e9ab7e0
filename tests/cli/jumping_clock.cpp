// Loaded before the C library, a wall clock that jumps to and fro by hours each time it is read. Clocks that cannot be
// set (CLOCK_MONOTONIC) are left alone.
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

namespace {

long jump() {
  static long calls = 0;
  return ++calls % 2 == 0 ? 7200 : -86400;  // s
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) {
  const long status = syscall(SYS_clock_gettime, clock, time);
  if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) time->tv_sec += jump();
  return static_cast<int>(status);
}

extern "C" time_t time(time_t* out) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != nullptr) *out = now.tv_sec;
  return now.tv_sec;
}
