#include "polder/verify/paper_figures.hpp"

namespace polder::validate {
namespace {

constexpr PaperFigure figures[] = {
    {"P0", "1D consolidation", "pressure against Terzaghi", "`polder verify terzaghi`"},
    {"P0", "free water", "Poiseuille flow and its start-up", "`polder verify poiseuille couette`"},
    {"P0", "heave", "onset at a sheet pile", "excavation-onset, in the table above"},
    {"P0", "heave", "failure, inflow, sedimentation", "excavation-heave"},
    {"P1", "1, 2", "geometry and grid", "dike-seepage (the drawing of its report)"},
    {"P1", "3", "porosity at 6, 8, 14, 23 s", "dike-paper (the paper's rule), dike-seepage (ours)"},
    {"P1", "4", "finite-element mesh", "dike-seepage-fem, `polder seepage`"},
    {"P1", "5 left", "deviatoric strain by finite elements",
     "`polder seepage dike-seepage-fem --set seepage.deformation=true`"},
    {"P1", "5 right", "deviatoric strain with Darcy's law", "dike-paper-darcy, dike-seepage-darcy"},
    {"P1", "beyond", "reservoir at a constant head", "dike-constant-head"},
    {"P2", "1", "single-point model", "pipe-leak (the drawing of its report)"},
    {"P2", "2", "double-point model", "pipe-leak-inflow (the drawing of its report)"},
    {"P2", "3", "excess pressure, 10 kPa, 2 s", "pipe-leak-10kpa"},
    {"P2", "4", "excess pressure over the orifice for all pressures", "`polder study pipe-leak-pressure`"},
    {"P2", "5", "vertical displacement at 10 and 14.5 kPa", "pipe-leak-10kpa, pipe-leak"},
    {"P2", "6", "vertical displacement at 16 kPa", "pipe-leak-16kpa"},
    {"P2", "7", "porosity at 1 and 10 mm/s",
     "pipe-leak-inflow, pipe-leak-inflow-fast; with Kozeny-Carman's permeability pipe-leak-inflow-kozeny, "
     "pipe-leak-inflow-kozeny-fast"},
    {"P2", "8", "vertical displacement at 10 mm/s", "pipe-leak-inflow-fast"},
    {"P2", "beyond", "orifice under constant head", "pipe-leak-head"},
    {"P2", "beyond", "orifice of 4 mm", "pipe-leak-4mm"},
    {"P3", "1, 2", "the method", "docs/theory.md"},
    {"P3", "3, 4, 5", "flow through a porous block", "porous-block, porous-block-dry"},
    {"P3", "6", "set-up of the embankment", "overtopping (the drawing of its report)"},
    {"P3", "7, 8", "H = 0.2 m", "overtopping-020"},
    {"P3", "9, 10", "H = 0.25 m", "overtopping-025"},
    {"P3", "11, 12", "H = 0.395 m", "overtopping, overtopping-paper"},
    {"P3", "13", "cohesion", "`polder study overtopping-cohesion`"},
    {"P3", "14", "angle of friction", "`polder study overtopping-friction`"},
    {"P3", "15", "initial porosity", "`polder study overtopping-porosity`"},
    {"P3", "16", "largest porosity", "`polder study overtopping-max-porosity`"},
    {"P3", "beyond", "two grids", "`polder study overtopping-grid`"},
    {"P4", "1, 2, 14", "mechanism and method", "docs/theory.md, docs/limits.md"},
    {"P4", "3, 4, 11", "the centrifuge test", "not ours: an experiment"},
    {"P4", "5, 6", "model, pressure of the phases", "levee-uplift-paper, levee-stability and its phases"},
    {"P4", "7–10", "stresses, strains, displacements, energy, uplift length", "levee-uplift-paper"},
    {"P4", "12, 13", "conductivity ratio", "`polder study levee-permeability`"},
    {"P4", "15", "slip surfaces by Uplift-Van", "levee-stability-2 to levee-stability-5, `polder stability`"},
    {"P4", "16, 17", "strength reduction by finite elements",
     "levee-stability, levee-stability-2, levee-stability-112kpa, levee-stability-3, `polder stability`"},
    {"P4", "beyond", "the clay's own permeability, water as stiff as it is", "levee-uplift"},
};

}  // namespace

std::span<const PaperFigure> paper_figures() { return figures; }

}  // namespace polder::validate
