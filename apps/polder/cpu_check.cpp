// Stops with a message, instead of "Illegal instruction", on a processor without the instructions that Polder is built
// for (x86-64-v3: AVX2 and what came with it, 2013). The one file that is compiled for any x86-64 processor. It runs
// before the constructors of all others, and uses no function of theirs nor of the C++ library, whose inline functions
// the linker may take from a file compiled for x86-64-v3.
#include <cpuid.h>
#include <unistd.h>

#include <cstring>

namespace {

bool has_x86_64_v3() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  __builtin_cpu_init();
  const bool vectors = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                       __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool basic = __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_MOVBE) != 0 && (c & bit_F16C) != 0;
  const bool extended = __get_cpuid(0x80000001, &a, &b, &c, &d) != 0 && (c & bit_LZCNT) != 0;
  return vectors && basic && extended;
}

[[gnu::constructor(101)]] void check_processor() {
  if (has_x86_64_v3()) return;
  const char message[] =
      "polder: this processor lacks instructions that Polder is built for (x86-64-v3: AVX2, FMA, BMI2).\n"
      "Build it for this machine instead: cmake --preset native && cmake --build --preset native --target polder\n";
  const ssize_t written = write(STDERR_FILENO, message, std::strlen(message));
  _exit(written < 0 ? 4 : 2);
}

}  // namespace
