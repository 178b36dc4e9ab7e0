#include "polder/seepage/chain_sides.hpp"

#include <map>

namespace polder {

std::vector<std::vector<Point2>> chain_sides(std::vector<std::array<Point2, 2>> segments) {
  std::map<Point2, std::size_t> starting;
  std::map<Point2, int> ending;
  for (std::size_t i = 0; i < segments.size(); ++i) starting[segments[i][0]] = i, ++ending[segments[i][1]];
  std::vector<bool> used(segments.size(), false);
  std::vector<std::vector<Point2>> chains;
  const auto follow = [&](std::size_t i) {
    std::vector<Point2> chain{segments[i][0]};
    while (!used[i]) {
      used[i] = true;
      chain.push_back(segments[i][1]);
      const auto next = starting.find(segments[i][1]);
      if (next == starting.end()) break;
      i = next->second;
    }
    chains.push_back(std::move(chain));
  };
  for (std::size_t i = 0; i < segments.size(); ++i)  // those that nothing leads to come first
    if (!ending.contains(segments[i][0]) && !used[i]) follow(i);
  for (std::size_t i = 0; i < segments.size(); ++i)
    if (!used[i]) follow(i);
  return chains;
}

}  // namespace polder
