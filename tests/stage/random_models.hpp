#pragma once
// Random but valid models, each from one number, and what must hold for every one of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {

/// A model's text and what it claims.
struct RandomModel {
  std::string text;
  bool solid = false;        ///< in three dimensions
  bool unsaturated = false;  ///< of that formulation
  bool at_rest = false;      ///< level layers, level water: the soil must stay where it is
  double cell = 0;           ///< m
};

/// What models of the unsaturated formulation have: finer cells in a range; free water and rain, in plane strain.
enum class Unsaturated { plain, finer, under_water };

class ModelGenerator {
 public:
  /// What came later draws from its own stream, so that the models of a seed keep their ground.
  explicit ModelGenerator(std::uint64_t seed, Unsaturated unsaturated = Unsaturated::plain)
      : random_(seed),
        more_(seed ^ 0x9E3779B97F4A7C15ULL),
        grid_(seed ^ 0xC2B2AE3D27D4EB4FULL),
        unsaturated_(unsaturated) {}

  RandomModel make() {
    RandomModel model;
    Ground g;
    g.solid = model.solid = chance(0.25);
    g.at_rest = model.at_rest = chance(0.4);
    g.unsaturated = more(0.2);
    g.single_point = chance(0.3) || g.unsaturated;
    g.cell = model.cell = model.solid ? pick({0.25, 0.5}) : pick({0.1, 0.2, 0.25});
    g.length = g.cell * whole(8, model.solid ? 10 : 24);
    const double depth = model.solid ? g.cell * whole(2, 4) : 0;
    g.height = g.cell * whole(8, model.solid ? 10 : 16);
    g.layers = whole(1, 3);
    const bool on_grid = model.at_rest && chance(0.5);
    const double layer_cells = std::max(1.0, std::round(g.height * between(0.3, 0.6) / g.layers / g.cell));
    g.soil = on_grid ? g.layers * layer_cells * g.cell : g.height * between(0.3, 0.6);
    g.water = model.at_rest && !chance(0.3) ? g.soil : between(0.2 * g.soil, g.soil);

    model.text = fmt::format(
        "[model]\ntitle = \"random\"\nsize = {}\ncell = {}\nspace = \"{}\"\nformulation = \"{}\"\npoints_per_axis = "
        "{}\n",
        model.solid ? fmt::format("[{}, {}, {}]", g.length, depth, g.height)
                    : fmt::format("[{}, {}]", g.length, g.height),
        g.cell, model.solid ? "3d" : "plane-strain",
        g.unsaturated    ? "unsaturated"
        : g.single_point ? "single-point"
                         : "double-point",
        whole(2, 3));
    if (g.unsaturated ? unsaturated_ == Unsaturated::finer : draw(grid_, 0, 1) < 0.3) model.text += finer(g);
    model.unsaturated = g.unsaturated;
    std::string materials;
    for (int layer = 0; layer < g.layers; ++layer) materials += material(layer, model.at_rest);
    g.end = model.at_rest ? g.length : g.length * between(0.4, 0.8);
    g.toe = model.at_rest ? g.length : std::min(g.length, g.end + g.soil * between(0, 2.5));
    for (int layer = 0; layer < g.layers; ++layer) {
      const double low = g.soil * layer / g.layers, high = g.soil * (layer + 1) / g.layers;
      const auto right = [&](double y) { return g.toe - (g.toe - g.end) * y / g.soil; };
      model.text += fmt::format(
          "[[soil]]\nname = \"layer {0}\"\nmaterial = \"soil {0}\"\npolygon = [[0, {1}], [{2}, {1}], [{3}, {4}], [0, "
          "{4}]]\n",
          layer, low, right(low), right(high), high);
    }
    // level water in the soil; where it ends, the water is at the toe
    g.beside = model.at_rest ? g.water : std::min(g.water, 0.5 * g.soil);
    std::string water_table = fmt::format("[[0, {}], [{}, {}]]", g.water, g.end, g.beside);
    std::string pond;
    if (model.at_rest && !g.unsaturated && chance(0.5)) {
      // on a line of the grid, so that a level which is held there finds it
      g.pond = g.cell * (std::ceil(g.soil / g.cell - 1e-9) + whole(1, 2));
      water_table = fmt::format("[[0, {0}], [{1}, {0}]]", g.soil, g.length);
      pond = fmt::format("[[free_water]]\nname = \"pond\"\nbox = [[0, {}], [{}, {}]]\n", g.soil, g.length, g.pond);
    }
    model.text += "[initial]\nstress = \"k0\"\nwater_table = " + water_table + "\n" + pond;
    model.text += fmt::format("[[boundary]]\nside = \"base\"\nsoil = \"{}\"\n", chance(0.5) ? "rough" : "roller");
    if (!model.solid && !g.unsaturated && chance(0.25)) {
      const double x = g.cell * std::round(0.3 * g.length / g.cell);
      model.text += fmt::format("[[wall]]\nname = \"sheet\"\nline = [[{0}, {1}], [{0}, {2}]]\n", x, g.height,
                                g.cell * std::round(0.4 * g.soil / g.cell));
      if (more(0.3)) model.text += "until = 0.1\n";
    }
    const bool under_water = unsaturated_ == Unsaturated::under_water && g.unsaturated && !model.solid;
    model.at_rest = model.at_rest && !under_water;
    if (g.unsaturated)
      model.text += retentions(g.layers) + (under_water ? over_the_ground(g) : pore_water(g));
    else
      model.text += g.at_rest ? held_level(g) : water_beside(g);
    if (!g.unsaturated && more(0.2)) {
      model.text += load(g);
      model.at_rest = false;
    }
    if (chance(0.3)) model.text += "[[stage]]\nname = \"settle\"\ninitial = true\nduration = 0.05\ndamping = 10\n";
    model.text += "[[stage]]\nname = \"run\"\nduration = 0.25\n" + materials;
    return model;
  }

 private:
  struct Ground {
    bool solid = false, at_rest = false, single_point = false, unsaturated = false;
    int layers = 1;
    double cell = 0, length = 0, height = 0;  ///< m
    double soil = 0, end = 0, toe = 0;        ///< m, its height, and where its surface and its base end
    double water = 0, beside = 0, pond = 0;  ///< m, levels in the soil, where it ends, and of the water on it (0: none)
  };

  /// Cells half or a third as large in a range of the height, whose ends and the model's are lines of the grid.
  std::string finer(const Ground& g) {
    const int cells = static_cast<int>(std::lround(g.height / g.cell)), parts = draw(grid_, 0, 1) < 0.5 ? 2 : 3;
    int from = static_cast<int>(draw(grid_, 0, cells - 4)), to = from + 1 + static_cast<int>(draw(grid_, 0, 2));
    if (from < 3) from = 0;
    if (to > cells - 3) to = cells;
    return fmt::format("[[refine]]\nalong = \"height\"\nspan = [{}, {}]\ncell = {}\ngrowth = {}\n", from * g.cell,
                       to * g.cell, g.cell / parts, draw(grid_, 1.1, 1.3));
  }

  static double draw(std::mt19937_64& from, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(from);
  }
  double between(double low, double high) { return draw(random_, low, high); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(double share) { return between(0, 1) < share; }
  double pick(std::initializer_list<double> of) { return of.begin()[whole(0, static_cast<int>(of.size()) - 1)]; }
  bool more(double share) { return draw(more_, 0, 1) < share; }

  /// A reservoir or an open side that gives the level which is there already.
  std::string held_level(const Ground& g) {
    std::string text;
    if (g.pond > 0 && more(0.4))
      text += fmt::format(
          "[[boundary]]\nname = \"lake\"\nwater = \"reservoir\"\nregion = [[0, {0}], [{1}, {0}], [{1}, {2}], [0, "
          "{2}]]\nhead = {3}\n",
          g.soil, 2 * g.cell, g.height, g.pond);
    if (more(0.3))
      text +=
          fmt::format("[[boundary]]\nside = \"right\"\nwater = \"head\"\nhead = {}\n", g.pond > 0 ? g.pond : g.water);
    return text;
  }

  /// Free water on the slope, a river with a hydrograph, a gate that holds a flood back for a while, or a head behind
  /// the soil that changes.
  std::string water_beside(const Ground& g) {
    std::string text;
    const double left = std::floor((g.length - g.toe) / g.cell + 1e-9);  // whole cells beyond the toe
    const double high = std::min(g.height - g.cell, g.soil * draw(more_, 0.6, 1.2));
    if (left >= 5 && !g.solid && more(0.5)) {
      const double gate = g.length - 3 * g.cell;
      text += fmt::format(
          "[[wall]]\nname = \"gate\"\nline = [[{0}, 0], [{0}, {1}]]\nuntil = {2}\n[[free_water]]\nname = "
          "\"flood\"\nbox = [[{0}, 0], [{3}, {4}]]\n",
          gate, g.height, draw(more_, 0.02, 0.1), g.length, high);
    } else if (g.beside > 0.5 * g.cell && more(0.6)) {
      text += fmt::format("[[free_water]]\nname = \"river\"\nbox = [[{}, 0], [{}, {}]]\n", g.end, g.length, g.beside);
      if (left >= 2 && more(0.6))
        text += fmt::format(
            "[[boundary]]\nname = \"river\"\nwater = \"reservoir\"\nregion = [[{0}, 0], [{1}, 0], [{1}, {2}], [{0}, "
            "{2}]]\nhead = [[0, {3}], [0.2, {4}]]\n",
            g.length - 2 * g.cell, g.length, g.height, g.beside, more(0.5) ? high : 0.5 * g.beside);
    }
    if (more(0.3))
      text += fmt::format("[[boundary]]\nside = \"left\"\nwater = \"head\"\nhead = [[0, {}], [0.2, {}]]\n", g.water,
                          g.soil * draw(more_, 0.2, 1.2));
    return text;
  }

  /// A pressure on a part of the ground, raised within a tenth of a second.
  std::string load(const Ground& g) {
    const double from = g.end * draw(more_, 0, 0.5), to = from + g.end * draw(more_, 0.2, 0.5);
    return fmt::format("[[load]]\nname = \"store\"\nspan = [{}, {}]\npressure = [[0, 0], [0.1, {}]]\n", from, to,
                       draw(more_, 500, 20000));
  }

  std::string retentions(int layers) {
    std::string text;
    for (int layer = 0; layer < layers; ++layer) {
      text += fmt::format("[[retention]]\nmaterial = \"soil {}\"\n", layer);
      if (more(0.5))
        text += fmt::format("model = \"van-genuchten\"\ng_a = {}\ng_n = {}\nresidual = {}\n", draw(more_, 0.5, 5),
                            draw(more_, 1.3, 4), draw(more_, 0, 0.1));
      else
        text += fmt::format("model = \"linear\"\nslope = {}\nconductivity = \"{}\"\n", draw(more_, 1e-6, 5e-5),
                            more(0.5) ? "curve" : "constant");
    }
    return text;
  }

  /// Rain on the ground or a head at its side, where nothing is to stay at rest.
  std::string pore_water(const Ground& g) {
    if (g.at_rest) return {};
    std::string text;
    if (more(0.5))
      text += fmt::format(
          "[[seepage_boundary]]\nname = \"rain\"\nline = [[0, {0}], [{1}, {0}]]\ncondition = \"rain\"\nrate = {2}\n",
          g.soil, g.end, std::pow(10, draw(more_, -8, -4)));
    if (more(0.5))
      text += fmt::format(
          "[[seepage_boundary]]\nname = \"behind\"\nline = [[0, 0], [0, {0}]]\nhead = [[0, {1}], [0.2, {2}]]\n", g.soil,
          g.water, g.soil * draw(more_, 0.2, 1));
    return text;
  }

  /// A river at the toe, a pond on the crest, a cloudburst; at least one of them.
  std::string over_the_ground(const Ground& g) {
    std::string text;
    if (g.length - g.toe > 2 * g.cell && draw(grid_, 0, 1) < 0.6)
      text += fmt::format(
          "[[boundary]]\nname = \"river\"\nwater = \"reservoir\"\nregion = [[{0}, 0], [{1}, 0], [{1}, {2}], [{0}, "
          "{2}]]\n"
          "head = [[0, {3}], [0.2, {4}]]\n",
          g.length - 2 * g.cell, g.length, g.height, std::max(g.beside, g.cell), g.soil * draw(grid_, 0.3, 1.1));
    const double top = g.cell * (std::ceil(g.soil / g.cell - 1e-9) + 1);
    if (top < g.height && draw(grid_, 0, 1) < 0.4)
      text += fmt::format("[[free_water]]\nname = \"pond\"\nbox = [[0, {}], [{}, {}]]\n", g.soil,
                          g.end * draw(grid_, 0.3, 1), top);
    if (text.empty() || draw(grid_, 0, 1) < 0.4)
      text += fmt::format("[[rain]]\nrate = {}\n", std::pow(10, draw(grid_, -5, -1.5)));
    return text;
  }

  std::string material(int number, bool elastic_only) {
    const int law = elastic_only ? whole(0, 1) : whole(0, 4);
    const double modulus = std::pow(10, between(6, 8));
    std::string strength = fmt::format("young_modulus = {}\npoisson_ratio = {}\n", modulus, between(0.1, 0.4));
    const double cohesion = chance(0.5) ? 0 : between(0, 1e4);  // one draw a line: the order is then the same anywhere
    const std::string friction = fmt::format("friction_angle = \"{} deg\"\ncohesion = {}\n", between(25, 40), cohesion);
    const char* name = "linear-elastic";
    if (law == 1) name = "mohr-coulomb", strength += friction;
    if (law == 2) name = "drucker-prager", strength += friction;
    if (law == 3) name = "tresca", strength += fmt::format("undrained_shear_strength = {}\n", between(2e3, 5e4));
    if (law == 4)
      name = "mohr-coulomb", strength += friction + fmt::format("dilatancy_angle = \"{} deg\"\n", between(0, 10));
    const double porosity = between(0.3, 0.45);
    const double permeability = std::pow(10, between(-9, -1));
    return fmt::format(
               "[[material]]\nname = \"soil {}\"\nlaw = \"{}\"\ngrain_density = {}\nporosity = {}\nmax_porosity = {}\n"
               "drag = \"darcy\"\npermeability = {}\n",
               number, name, between(2500, 2800), porosity, porosity + 0.1, permeability) +
           strength;
  }

  std::mt19937_64 random_, more_, grid_;
  Unsaturated unsaturated_;
};

// In cells, of models at rest; the most of the first 300 models is 6.1e-4.
constexpr double most_moved = 1e-3;

/// How a model ended: after its last step here, or by a guard with its reason.
struct RandomEnding {
  bool finished = false;  ///< the whole 0.25 s, or 400 steps of them
  std::string reason;
  bool warned = false;  ///< that the flux on the grid is not that of the points
  double moved = 0;     ///< of a model at rest: the most that a grain moved, in cells
};

template <class Space>
RandomEnding run_random(const Model& read, const RandomModel& random) {
  RandomEnding ending;
  const char* threads = std::getenv("POLDER_THREADS");
  Simulation<Space> run(read, threads ? std::atoi(threads) : 1);
  try {
    for (int step = 0; step < 400 && !run.finished(); ++step) run.advance();
  } catch (const RunFailure& failure) {
    ending.reason = failure.what();
    return ending;
  }
  ending.finished = true;
  const auto look = [&](const auto& points) {
    for (std::size_t p = 0; p < points.size(); ++p) EXPECT_TRUE(std::isfinite(speed_squared(points, p)));
  };
  look(run.state().soil);
  look(run.state().water);
  for (const auto& component : run.state().soil.stress)
    for (const double s : component) EXPECT_TRUE(std::isfinite(s));
  EXPECT_LT(run.audit().solid_mass_error(run.state()), 1e-9);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-9);
  EXPECT_LE(run.guards().energy_now, run.guards().energy_allowed * 1.05);
  // a flux that cannot be trusted is never given without saying so
  for (const std::string& warning : run.guards().warnings())
    ending.warned = ending.warned || warning.starts_with("the flux");
  const FluxError flux = run.audit().worst_flux();
  EXPECT_TRUE(ending.warned || flux.error <= GuardLimits::flux_balance || flux.passed <= GuardLimits::flux_counts);
  if (random.at_rest) {
    const auto& soil = run.state().soil;
    for (int a = 0; a < Space::axes; ++a)
      for (std::size_t p = 0; p < soil.size(); ++p)
        ending.moved = std::max(ending.moved, std::abs(soil.position[a][p] - soil.reference[a][p]) / random.cell);
    EXPECT_LT(ending.moved, most_moved);
  }
  return ending;
}

/// Makes the model of `seed`, runs it and checks it.
inline RandomEnding try_random(std::uint64_t seed, Unsaturated unsaturated = Unsaturated::plain) {
  ModelGenerator generator(seed, unsaturated);
  const RandomModel random = generator.make();
  SCOPED_TRACE(fmt::format("model {}:\n{}", seed, random.text));
  const Model model = read_text(random.text);
  if (testing::Test::HasFatalFailure() || model.stages.empty()) return {false, "not read"};
  return random.solid ? run_random<Solid>(model, random) : run_random<PlaneStrain>(model, random);
}

}  // namespace polder
