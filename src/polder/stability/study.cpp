#include "polder/stability/study.hpp"

#include <algorithm>

#include "polder/seepage/model_flow.hpp"
#include "polder/stability/section_from_model.hpp"
#include "polder/stability/seepage_pressures.hpp"

namespace polder::stability {
namespace {

PreparedSection with_seepage(const Study& study, Section section) {
  const ModelFlow flow = model_flow(study.model, study.seepage);
  const FlowSolver solver(flow.problem());
  FlowState state;
  if (study.seepage.times.empty()) {
    state = solver.steady(study.seepage.steady_time);
  } else {
    state = study.seepage.start == SeepageStart::steady ? solver.steady(0) : initial_flow(study.model, solver);
    solver.advance(state, study.seepage.times.back());
  }
  double size = study.seepage.mesh_size;
  if (size <= 0) size = std::max(study.model.cell[0], study.model.cell[1]);
  take_pressures(solver, state, size / 4, section);
  return prepare(std::move(section));
}

}  // namespace

std::vector<StudySection> study_sections(const Study& study) {
  const Section section = section_from_model(study.model, study.input);
  std::vector<StudySection> sections;
  if (study.input.pressures != PressureSource::water_net) sections.push_back({"seepage", with_seepage(study, section)});
  if (study.input.pressures != PressureSource::seepage) sections.push_back({"water net", prepare(section)});
  return sections;
}

}  // namespace polder::stability
