// A checkpoint whose checksum is right, whatever its values: refused, or a state that the next steps can start from.
//
// An input is a list of changes to a sound state, eleven bytes each: the number of an array, the number of a value in
// it, and the bytes of the value. Most are put straight into a run, which is what restoring does and much faster; those
// whose first byte is 240 or more go through a checkpoint's bytes. So the fuzzer spends its time on what Polder reads,
// not on the library that unpacks it. (Data sets of another kind or length: tests/stage/checkpoint_test.cpp.)
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "polder/case/reader.hpp"
#include "polder/stage/checkpoint.hpp"
#include "scratch.hpp"

namespace {

using namespace polder;

constexpr std::size_t record = 11;  // bytes of a change

constexpr char case_text[] = R"(
[model]
size = ["0.4 m", "0.4 m"]
cell = "0.1 m"
points_per_axis = 1
[[material]]
name = "sand"
law = "mohr-coulomb"
grain_density = "2650 kg/m3"
porosity = 0.4
grain_diameter = "2 mm"
young_modulus = "1 MPa"
friction_angle = "35 deg"
[[soil]]
material = "sand"
box = [["0.2 m", "0 m"], ["0.4 m", "0.2 m"]]
[[free_water]]
box = [["0 m", "0 m"], ["0.4 m", "0.3 m"]]
[initial]
water_table = [["0 m", "0.3 m"], ["0.4 m", "0.3 m"]]
[[stage]]
name = "event"
duration = "1 s"
)";

/// The values of one array or number of the state, in the order in which each_state() names them.
using Blob = std::string;

/// archive(name, value or array) that copies.
struct Copy {
  std::vector<Blob>* to;
  template <class T>
  void operator()(const std::string&, T& value) const {
    if constexpr (std::is_arithmetic_v<T>)
      to->emplace_back(reinterpret_cast<const char*>(&value), sizeof value);
    else
      to->emplace_back(reinterpret_cast<const char*>(value.data()), value.size() * sizeof value[0]);
  }
};

/// archive(name, value or array) that takes what was copied, with the changes of an input.
struct Change {
  const std::vector<Blob>& from;
  const std::uint8_t* data;
  std::size_t size;
  std::size_t* number;  ///< of the array

  template <class T>
  void operator()(const std::string&, T& value) const {
    const std::size_t own = (*number)++;
    if constexpr (std::is_arithmetic_v<T>) {
      change(own, &value, 1);
    } else {
      value.resize(from[own].size() / sizeof value[0]);
      change(own, value.data(), value.size());
    }
  }

 private:
  template <class T>
  void change(std::size_t own, T* values, std::size_t count) const {
    std::memcpy(values, from[own].data(), count * sizeof(T));
    for (const std::uint8_t* at = data; at + record <= data + size && count > 0; at += record)
      if (at[0] % from.size() == own) std::memcpy(values + (at[1] + 256u * at[2]) % count, at + 3, sizeof(T));
  }
};

struct Sound {
  Model model;
  std::vector<Blob> state;
};

const Sound& sound() {
  static const Sound made = [] {
    Sound s;
    s.model = read_case(fuzz::scratch().write("case.toml", case_text)).model;
    Simulation<PlaneStrain> run(s.model, 1);
    for (int step = 0; step < 3; ++step) run.advance();
    run.each_state(Copy{&s.state});
    return s;
  }();
  return made;
}

/// Puts the state with the changes into the run; false where it is refused.
bool restore(const std::uint8_t* data, std::size_t size, Simulation<PlaneStrain>& run) {
  std::size_t number = 0;
  run.each_state(Change{sound().state, data, size, &number});
  if (!run.flaw().empty()) return false;
  run.restored();
  return true;
}

bool restore_from_bytes(const std::uint8_t* data, std::size_t size, Simulation<PlaneStrain>& run) {
  Simulation<PlaneStrain> other(sound().model, 1);
  std::size_t number = 0;
  other.each_state(Change{sound().state, data, size, &number});
  try {
    restore_checkpoint(checkpoint_bytes(other, OutputState{}, "case"), run, "case");
  } catch (const CheckpointError&) {
    return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Simulation<PlaneStrain> run(sound().model, 1);  // all that a step depends on is restored
  const bool bytes = size > 0 && data[0] >= 240;
  if (!(bytes ? restore_from_bytes(data, size, run) : restore(data, size, run))) {
    fuzz::refusals().add();
    return 0;
  }
  try {
    if (!run.finished()) run.advance();
  } catch (const RunFailure&) {
    // what a guard is for
  }
  return 0;
}
