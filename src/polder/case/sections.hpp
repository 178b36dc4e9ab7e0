#pragma once
// A case file's sections, read key by key: the step between the document and the model. Lists run parallel to the
// model's.
#include <string>
#include <string_view>
#include <vector>

#include "polder/case/fields.hpp"
#include "polder/case/model.hpp"

namespace polder::case_file {

struct Sections {
  Fields model, water, initial, output, numerics, stability, seepage;
  std::vector<Fields> materials, soils, free_water, boundaries, walls, stages, monitors, strengths, head_lines,
      line_loads, loads, retentions, seepage_boundaries, changes, wells, rains, dike_checks, refinements;
  std::vector<const LawDescription*> laws;  ///< of the materials; nullptr where unknown
};

/// The tables of a section in a document: none, one, or the entries of a list.
std::vector<const Value*> tables_of(const Value& document, const Section& section, Diagnostics& diagnostics);

/// "soil.dike" where the entry has a name, else "soil.2".
std::string path_of_entry(const Section& section, const Value& table, std::size_t index);

/// A material's keys are the section's and those of its law. Of an unknown law any law's keys pass. Where a variant
/// changes the law of its base, what the base says to its own law falls away.
Fields read_material_section(const Value& table, const std::string& path, const LawDescription*& law,
                             Diagnostics& diagnostics);

/// Reports a key that a section cannot do without.
void need(const Fields& fields, std::string_view key, Diagnostics& diagnostics);

/// What the section says under `key`, reported where no [[material]] has the name; empty where it says nothing.
std::string known_material(const Fields& fields, std::string_view key, const Model& model, Diagnostics& diagnostics);

/// What the section says under `material`, reported where it is missing or no [[material]] has the name.
std::string material_named(const Fields& fields, const Model& model, Diagnostics& diagnostics);

Sections read_sections(const Value& document, Diagnostics& diagnostics);

/// Density and porosity of a material from whichever of ρs, n, e, γ_unsat, γ_sat are given; permeability from whichever
/// of k, k_h and k_v, κ. Contradictions and gaps are reported.
void settle_phases(const Fields& fields, const WaterProperties& water, MaterialInput& material,
                   Diagnostics& diagnostics);
void settle_permeability(const Fields& fields, const WaterProperties& water, double gravity, MaterialInput& material,
                         Diagnostics& diagnostics);

/// What no single key can tell: bodies outside the model or on top of each other, a grid that does not fit, names that
/// nobody has… Snaps sizes and lines to the grid where they are within round-off of it.
void check_model(const Sections& sections, Model& model, Diagnostics& diagnostics);

/// Sizes that are whole cells; ranges of finer cells, which it takes into the model.
void check_grid(const Sections& sections, Model& model, Diagnostics& diagnostics);

/// Sides with a head or an inflow: what is missing, and whether the opening fits the side and the grid.
void check_openings(const Sections& sections, const Model& model, Diagnostics& diagnostics);

/// Walls that are not in the model or too short for the grid; says how far a wall is from the faces that it lies on.
void check_walls(const Sections& sections, const Model& model, Diagnostics& diagnostics);

/// Sides that move or that water sticks to, gravity that leans, models without ends.
void check_sides(const Sections& sections, const Model& model, Diagnostics& diagnostics);

/// What may be written but cannot be computed by this version.
void check_limits(const Sections& sections, const Model& model, Diagnostics& diagnostics);

}  // namespace polder::case_file
