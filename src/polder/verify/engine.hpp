#pragma once
// Running a case to its end inside this program, and reading the state on the way.
#include <algorithm>
#include <cmath>
#include <vector>

#include "polder/stage/simulation.hpp"

namespace polder::verify {

/// Runs the case; `watch(run)` after each step of the event.
template <class Space, class Watch>
void run_case(Simulation<Space>& run, Watch&& watch) {
  while (!run.finished()) {
    const bool initial = run.stage()->initial;
    run.advance();
    if (!initial) watch(run);
  }
}

/// first/parts, …, parts/parts: where an exact curve is drawn.
inline std::vector<double> fractions(int parts, int first = 0) {
  std::vector<double> all;
  for (int i = first; i <= parts; ++i) all.push_back(static_cast<double>(i) / parts);
  return all;
}

/// Values at given times, linear between the steps.
class Samples {
 public:
  explicit Samples(std::vector<double> at) : times(std::move(at)) {}

  void take(double time, const std::vector<double>& value) {
    while (rows.size() < times.size() && times[rows.size()] <= time * (1 + 1e-12)) {
      const double share = last_.empty() ? 1 : (times[rows.size()] - last_time_) / (time - last_time_);
      std::vector<double> row = value;
      for (std::size_t i = 0; i < last_.size(); ++i) row[i] = last_[i] + share * (value[i] - last_[i]);
      rows.push_back(row);
    }
    last_time_ = time;
    last_ = value;
  }

  std::vector<double> times;              ///< s, increasing
  std::vector<std::vector<double>> rows;  ///< one per time

 private:
  double last_time_ = 0;
  std::vector<double> last_;
};

/// Mean over the horizontal row of cells `level` of a cell field.
template <class Space>
double row_mean(const Lattice<Space>& lattice, const Array& field, int level) {
  double sum = 0;
  int number = 0;
  const int depth = Space::axes == 3 ? lattice.cells[1] : 1;
  for (int j = 0; j < depth; ++j)
    for (int i = 0; i < lattice.cells[0]; ++i, ++number)
      sum += field[Space::axes == 3 ? lattice.index(i, j, level) : lattice.index(i, level)];
  return sum / number;
}

/// The same at a height (m), linear between the centres of the cells and beyond.
template <class Space>
double mean_at_height(const Lattice<Space>& lattice, const Array& field, double height) {
  const double place = height / lattice.spacing[Space::up] - 0.5;
  int low = static_cast<int>(std::floor(place));
  low = std::min(std::max(low, 0), lattice.cells[Space::up] - 2);
  const double share = place - low;
  return (1 - share) * row_mean(lattice, field, low) + share * row_mean(lattice, field, low + 1);
}

/// Fastest point of either phase, m/s.
template <class Space>
double fastest_point(const Stepper<Space>& state) {
  double most = 0;
  const auto look = [&](const auto& points) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      double square = 0;
      for (const auto& v : points.velocity) square += v[p] * v[p];
      most = std::max(most, square);
    }
  };
  look(state.water);
  look(state.soil);
  return std::sqrt(most);
}

}  // namespace polder::verify
