// polder element MATERIAL: laboratory tests on one point of each material of a file; tables as CSV, curves as PNG.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>

#include "commands.hpp"
#include "polder/case/element_input.hpp"
#include "polder/case/locate.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/chart.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/paint.hpp"

namespace polder::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file;
  fs::path out;
  std::vector<std::string> overrides;
  bool force = false;
};

/// What is written of a row, in the order of the columns.
struct Column {
  const char* header;
  double ElementRow::*value;
};

constexpr Column columns[] = {{"axial strain [-]", &ElementRow::axial_strain},
                              {"lateral strain [-]", &ElementRow::lateral_strain},
                              {"volumetric strain [-]", &ElementRow::volumetric_strain},
                              {"shear strain [-]", &ElementRow::shear_strain},
                              {"axial stress [Pa]", &ElementRow::axial},
                              {"lateral stress [Pa]", &ElementRow::lateral},
                              {"out-of-plane stress [Pa]", &ElementRow::out_of_plane},
                              {"shear stress [Pa]", &ElementRow::shear},
                              {"mean stress [Pa]", &ElementRow::mean},
                              {"deviator [Pa]", &ElementRow::deviator},
                              {"pore pressure [Pa]", &ElementRow::pore_pressure},
                              {"porosity [-]", &ElementRow::porosity},
                              {"plastic shear strain [-]", &ElementRow::plastic_shear_strain}};

/// How the curves of a type of test are drawn: what against what.
struct Figure {
  const char *name, *horizontal, *vertical;
  const char *horizontal_unit, *vertical_unit;
  double ElementRow::*x;
  double ElementRow::*y;
};

std::vector<Figure> figures_of(ElementTest test) {
  const Figure deviator{
      "stress", "axial strain", "deviator", "", "Pa", &ElementRow::axial_strain, &ElementRow::deviator};
  const Figure shear{"stress", "shear strain", "shear stress", "", "Pa", &ElementRow::shear_strain, &ElementRow::shear};
  Figure volume = deviator, pressure = deviator;
  volume.name = "volume", volume.vertical = "volumetric strain", volume.vertical_unit = "";
  volume.y = &ElementRow::volumetric_strain;
  pressure.name = "pressure", pressure.vertical = "excess pore pressure", pressure.y = &ElementRow::pore_pressure;
  const auto of_shear = [](Figure figure) {
    figure.horizontal = "shear strain";
    figure.x = &ElementRow::shear_strain;
    return figure;
  };
  switch (test) {
    case ElementTest::oedometer:
      return {
          {"compression", "vertical stress", "axial strain", "Pa", "", &ElementRow::axial, &ElementRow::axial_strain}};
    case ElementTest::triaxial_drained:
      return {deviator, volume};
    case ElementTest::triaxial_undrained:
      return {deviator, pressure};
    case ElementTest::simple_shear:
      return {shear, of_shear(volume)};
    case ElementTest::simple_shear_undrained:
      return {shear, of_shear(pressure)};
  }
  return {};
}

std::string file_name(std::string text, std::set<std::string>& used) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  std::string name = text;
  for (int i = 2; !used.insert(name).second; ++i) name = fmt::format("{}_{}", text, i);
  return name;
}

std::string table_of(const ElementResult& result) {
  std::string text;
  for (const Column& column : columns) text += fmt::format("{}{}", text.empty() ? "" : ",", column.header);
  text += '\n';
  for (const ElementRow& row : result.rows) {
    for (const Column& column : columns) text += fmt::format("{}{}", &column == columns ? "" : ",", row.*column.value);
    text += '\n';
  }
  return text;
}

ElementInput read_input(const Options& options) {
  const auto path = find_case(options.file);
  if (!path)
    throw Failure(status_wrong_input, options.file +
                                          ": there is no such file; give a TOML file with a [[material]], "
                                          "or the name of a shipped case ('polder list')");
  ElementInput input = read_element_file(path->string(), options.overrides);
  if (!input.diagnostics.empty()) std::cerr << format(input.diagnostics);
  if (!input.ok()) throw Failure(status_wrong_input, "no test was run");
  return input;
}

void print_header() {
  fmt::print("{:<18} {:<24} {:>12} {:>12} {:>12} {:>12} {:>9}\n", "material", "test", "peak q kPa", "end q kPa",
             "end p' kPa", "end u kPa", "end εv %");
}

void print_line(const ElementMaterial& material, const ElementRun& run, const ElementResult& result) {
  double peak = 0;
  for (const ElementRow& row : result.rows) peak = std::max(peak, row.deviator);
  const ElementRow& end = result.rows.back();
  fmt::print("{:<18} {:<24} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.4g} {:>9.4g}\n", material.name, run.name, peak / 1e3,
             end.deviator / 1e3, end.mean / 1e3, end.pore_pressure / 1e3, end.volumetric_strain * 100);
  if (!result.stopped.empty()) fmt::print("  ended early: {}\n", result.stopped);
}

void draw(const fs::path& folder, const ElementInput& input, const std::vector<ElementResult>& results) {
  std::set<ElementTest> types;
  for (const ElementRun& run : input.runs) types.insert(run.path.test);
  for (const ElementTest type : types)
    for (const Figure& figure : figures_of(type)) {
      Chart chart;
      chart.title = std::string(element_test_name(type));
      chart.horizontal = figure.horizontal, chart.horizontal_unit = figure.horizontal_unit;
      chart.vertical = figure.vertical, chart.vertical_unit = figure.vertical_unit;
      for (std::size_t i = 0; i < results.size(); ++i) {
        const ElementRun& run = input.runs[i];
        if (run.path.test != type) continue;
        const std::string& material = input.materials[static_cast<std::size_t>(run.material)].name;
        Curve curve;
        curve.name = run.name == element_test_name(type) ? material : material + ", " + run.name;
        for (const ElementRow& row : results[i].rows)
          curve.x.push_back(row.*figure.x), curve.y.push_back(row.*figure.y);
        chart.curves.push_back(std::move(curve));
      }
      write_drawing(folder / fmt::format("{}_{}.png", element_test_name(type), figure.name), draw_chart(chart));
    }
}

int element(const Options& options) {
  const ElementInput input = read_input(options);
  const fs::path folder =
      options.out.empty() ? fs::path(fs::path(options.file).stem().string() + "-element") : options.out;
  if (fs::is_directory(folder) && !fs::is_empty(folder) && !options.force)
    throw Failure(status_wrong_input,
                  folder.string() + ": holds files already; give another --out, or --force to write over them");
  std::vector<ElementResult> results;
  print_header();
  for (const ElementRun& run : input.runs) {
    const ElementMaterial& material = input.materials[static_cast<std::size_t>(run.material)];
    const auto law = material.law->make(material.law_parameters, {0, material.porosity, material.max_porosity});
    results.push_back(run_element_test(*law, run.path, material.porosity, material.max_porosity));
    print_line(material, run, results.back());
  }
  try {
    make_folder(folder);
    std::set<std::string> used;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const ElementRun& run = input.runs[i];
      const std::string& material = input.materials[static_cast<std::size_t>(run.material)].name;
      write_atomically(folder / (file_name(material + "_" + run.name, used) + ".csv"), table_of(results[i]));
    }
    draw(folder, input, results);
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  }
  std::cout << folder.string() << '\n';
  return std::cout.flush() ? status_done : status_not_written;
}

}  // namespace

void add_element(CLI::App& polder, Action& action) {
  CLI::App* command =
      add_command(polder, "element", "Oedometer, triaxial and simple shear tests on one point of a material",
                  "polder element sand.toml\npolder element dike-seepage --out sand\n"
                  "polder element sand.toml --set \"material.sand.friction_angle=36 deg\" --force");
  command->description(
      "Oedometer, triaxial and simple shear tests on one point of a material\n"
      "MATERIAL has [[material]] sections as a case file, and [[test]] sections (type, vertical_stress, stress_ratio,\n"
      "strain, loads, steps); without them the standard tests are run at 100 kPa. It may be a case file.\n"
      "Results: a table of each test (CSV; compression positive) and curves by type of test (PNG).");
  const auto options = std::make_shared<Options>();
  command->add_option("MATERIAL", options->file, "File with materials, or the name of a shipped case")->required();
  command->add_option("--out", options->out, "Folder of the results; MATERIAL-element where it is not given");
  command->add_option("--set", options->overrides, "key=value, as in the file; may be repeated")->take_all();
  command->add_flag("--force", options->force, "Write into a folder that is not empty");
  command->callback([options, &action] { action = [options] { return element(*options); }; });
}

}  // namespace polder::cli
