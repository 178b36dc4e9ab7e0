// synthetic_run DIR [SPACING [FRAMES [running]]]: a run's folder and its report.html, for the tests of the viewer.
#include <cstdlib>
#include <iostream>
#include <string>

#include "../synthetic_run.hpp"
#include "polder/report/report.hpp"

int main(int count, char** words) {
  if (count < 2) {
    std::cerr << "usage: synthetic_run DIR [SPACING [FRAMES [running]]]\n";
    return 2;
  }
  polder::SyntheticRun run;
  if (count > 2) run.spacing = std::stod(words[2]);
  if (count > 3) run.frames = std::stoi(words[3]);
  run.finished = count <= 4;
  polder::write_synthetic_run(words[1], run);
  polder::write_report(words[1], {run.finished ? 0.0 : 2.0});
}
