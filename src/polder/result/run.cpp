#include "polder/result/run.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "polder/case/model_json.hpp"
#include "polder/case/wall_motion.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/frame_of.hpp"
#include "polder/result/history.hpp"
#include "polder/result/model_drawing.hpp"
#include "polder/result/monitors.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/picture_files.hpp"
#include "polder/result/progress.hpp"
#include "polder/result/run_folder.hpp"
#include "polder/result/state_hash.hpp"
#include "polder/result/vtk.hpp"
#include "polder/result/vtk_reader.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/step/kernels.hpp"

namespace polder {

namespace {

constexpr double round_off = 1e-9;

template <class Space>
class Run {
 public:
  Run(const Model& model, const RunOptions& options)
      : model_(model),
        options_(options),
        case_text_(case_identity(model)),
        folder_(options.folder, options.resume, options.force),
        simulation_(std::make_unique<Simulation<Space>>(model, options.threads)),
        progress_(options.quiet) {
    std::sort(model_.output.pictures.begin(), model_.output.pictures.end());
    begin_ = simulation_->time();
    end_ = std::min(simulation_->end_time(), options.until.value_or(simulation_->end_time()));
    if (options.resume) resume();
    open_log();
    start_wall_ = output_.wall_seconds;
    start_step_ = simulation_->state().step;
  }

  Summary go() {
    summary_.status = RunStatus::finished;
    summary_.reason = "the last stage is complete";
    double last_checkpoint = 0;
    try {
      record_due();
      while (!simulation_->finished()) {
        if (recording() && simulation_->time() >= end_ * (1 - round_off)) {
          summary_.reason = fmt::format("t = {:g} s is reached, as asked", end_);
          break;
        }
        if (options_.interrupted && options_.interrupted->load()) {
          summary_.status = RunStatus::interrupted;
          summary_.reason = fmt::format("interrupted at t = {:.6g} s; go on with --resume", simulation_->time());
          break;
        }
        const StepReport report = simulation_->advance();
        output_.last_dt = report.dt;
        point_steps_ += static_cast<double>(simulation_->state().soil.size() + simulation_->state().water.size());
        measure();
        record_due();
        progress_.show([&] { return progress_state(); });
        if (progress_.wall_seconds() - last_checkpoint > model_.output.checkpoint_interval) {
          checkpoint();
          last_checkpoint = progress_.wall_seconds();
        }
      }
      checkpoint();
    } catch (const RunFailure& failure) {
      summary_.status = RunStatus::failed;
      summary_.reason = failure.what();
      write_atomically(folder_.path() / "failed.h5", checkpoint_bytes(*simulation_, output_, case_text_));
      add_snapshot(folder_.path(), series_, frame_of(*simulation_));
      log_->error("{}; the state is kept in failed.h5 and in the last snapshot", failure.what());
    }
    progress_.finish();
    finish();
    return summary_;
  }

 private:
  bool recording() const { return simulation_->finished() || !simulation_->stage()->initial; }

  void resume() {
    std::string trouble;
    for (const auto& path : folder_.checkpoints()) {
      try {
        output_ = restore_checkpoint(read_file(path), *simulation_, case_text_);
        resumed_from_ = path.filename().string();
        break;
      } catch (const CheckpointError& error) {
        trouble += fmt::format("\n  {}: {}", path.string(), error.what());
        simulation_ = std::make_unique<Simulation<Space>>(model_, options_.threads);
      }
    }
    if (resumed_from_.empty())
      throw FolderError("no checkpoint can be resumed from:" + trouble + "\nStart again with --force.");
    refused_ = trouble;
  }

  /// What a reader of the results wants beside them: the drawing of the model, and what the case is held against.
  void keep_case_papers() const {
    write_drawing(folder_.path() / "model.svg", draw_model(model_));
    const auto expected = std::filesystem::path(model_.file).parent_path() / "expected.toml";
    if (std::filesystem::exists(expected)) write_atomically(folder_.path() / "expected.toml", read_file(expected));
  }

  void open_log() {
    try {
      log_ = std::make_shared<spdlog::logger>(
          "run", std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder_.path() / "log.txt").string(), false));
    } catch (const spdlog::spdlog_ex& error) {
      throw OutputError((folder_.path() / "log.txt").string(), error.what());
    }
    log_->flush_on(spdlog::level::info);
    const auto& state = simulation_->state();
    if (!refused_.empty()) log_->warn("checkpoint refused:{}", refused_);
    if (options_.resume)
      log_->info("resumed from {} at t = {:.6g} s, step {}", resumed_from_, simulation_->time(), state.step);
    log_->info("polder {}, case {} ({})", options_.version, model_.name, model_.title);
    log_->info("{} cells, {} soil points, {} water points, {} thread(s), soil's step {:.3g} s",
               state.setup.lattice.cell_count(), state.soil.size(), state.water.size(), state.team.size(),
               state.setup.soil_step);
  }

  /// Opens history and monitors at the first moment of the event.
  void open_results() {
    keep_case_papers();
    monitors_ = std::make_unique<Monitors<Space>>(*simulation_, output_.followed);
    output_.followed = monitors_->followed();
    const auto path = folder_.path() / "history.csv";
    const bool again = options_.resume && output_.history_rows > 0;
    if (again)
      history_ = std::make_unique<HistoryFile>(path, monitors_->columns(), output_.history_rows);
    else
      history_ = std::make_unique<HistoryFile>(path, monitors_->columns());
    if (!options_.resume) return;
    // a snapshot of the checkpoint's own instant may be later than the checkpoint by round-off only; one of an initial
    // stage knows of no snapshot, not even that of the event's first instant
    const double known = again ? simulation_->time() * (1 + 1e-12) + 1e-300 : -1;
    series_ = resume_series(folder_.path(), known);
  }

  void record_due() {
    if (!recording()) return;
    if (!monitors_) open_results();
    const double t = simulation_->time();
    const auto due = [&](std::uint64_t& number, double interval) {
      if (t < static_cast<double>(number) * interval * (1 - round_off)) return false;
      number = static_cast<std::uint64_t>(t / interval * (1 + round_off)) + 1;
      return true;
    };
    // where a stage has intervals of its own, counting goes on with its next multiple
    const Stage& stage = model_.stages[std::min<std::size_t>(simulation_->stage_number(), model_.stages.size() - 1)];
    const auto change = [&](double& interval, std::optional<double> own, double general, std::uint64_t& number) {
      const double now = own.value_or(general);
      if (interval > 0 && now != interval) number = static_cast<std::uint64_t>(std::ceil(t / now * (1 - round_off)));
      interval = now;
    };
    change(history_interval_, stage.history_interval, model_.output.history_interval, output_.next_history);
    change(snapshot_interval_, stage.snapshot_interval, model_.output.snapshot_interval, output_.next_snapshot);
    if (due(output_.next_history, history_interval_)) {
      const auto row = monitors_->sample(*simulation_, output_.last_dt);
      history_->append(t, row);
      output_.history_rows = history_->rows();
    }
    bool snapshot = due(output_.next_snapshot, snapshot_interval_);
    std::optional<double> picture;
    while (output_.next_picture < model_.output.pictures.size() &&
           t >= model_.output.pictures[output_.next_picture] * (1 - round_off))
      picture = model_.output.pictures[output_.next_picture++];
    if (!snapshot && !picture) return;
    const Frame frame = frame_of(*simulation_);
    if (series_.empty()) write_section(folder_.path(), frame);
    add_snapshot(folder_.path(), series_, frame);
    if (picture) write_pictures(folder_.path(), frame, standard_pictures(frame), *picture, simulation_->state().team);
  }

  void checkpoint() {
    output_.wall_seconds = start_wall_ + progress_.wall_seconds();
    folder_.write_checkpoint(checkpoint_bytes(*simulation_, output_, case_text_));
    log_->info("checkpoint at t = {:.6g} s, step {}", simulation_->time(), simulation_->state().step);
  }

  void measure() {
    const auto& state = simulation_->state();
    fastest_ = std::max(fastest_, state.motion.speed * state.setup.lattice.smallest_spacing());
  }

  ProgressState progress_state() const {
    const auto& state = simulation_->state();
    return {simulation_->time(),
            begin_,
            end_,
            state.step,
            output_.last_dt,
            point_steps_,
            simulation_->audit().water_balance_error(state)};
  }

  void finish() {
    const auto& state = simulation_->state();
    const Audit<Space>& audit = simulation_->audit();
    const double wall = progress_.wall_seconds();
    const double points = static_cast<double>(state.soil.size() + state.water.size());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    Summary& s = summary_;
    s.warnings = simulation_->guards().warnings();
    for (const StageEnd& end : simulation_->stage_ends()) {
      s.stage_seconds[end.name] = end.seconds;
      if (end.restless > 0)
        s.warnings.push_back(fmt::format(
            "the stage \"{}\" did not come to rest within its {:.6g} s: its out-of-balance force was {:.2g} of "
            "the weight; give it more time or damping",
            end.name, end.seconds, end.restless));
    }
    for (const std::string& warning : s.warnings) log_->warn("{}", warning);
    s.version = options_.version;
    s.simulated_time = simulation_->time();
    s.steps = state.step;
    s.wall_seconds = start_wall_ + wall;
    s.threads = state.team.size();
    s.soil_points = state.soil.size();
    s.water_points = state.water.size();
    s.cells = static_cast<std::uint64_t>(state.setup.lattice.cell_count());
    s.bytes_per_point = 1024.0 * static_cast<double>(usage.ru_maxrss) / std::max(points, 1.0);
    s.point_steps_per_second = point_steps_ / std::max(wall, 1e-9);
    const auto steps = static_cast<double>(std::max<std::uint64_t>(audit.steps, 1));
    s.pressure_iterations_per_step = static_cast<double>(audit.pressure_iterations) / steps;
    s.volume_iterations_per_step = static_cast<double>(audit.volume_iterations) / steps;
    s.state_hash = hash_text(hash_of(*simulation_));
    s.overfilled_cells = audit.overfilled_most;
    s.flux_balance_error = audit.flux_balance_error();
    s.water_balance_error = audit.water_balance_error(state);
    s.solid_mass_error = audit.solid_mass_error(state);
    const Energies e = energies(*simulation_);
    s.energy = {{"soil_kinetic", e.soil_kinetic}, {"water_kinetic", e.water_kinetic}, {"potential", e.potential}};
    const auto& p = state.grid.pressure;
    s.maxima = {{"speed", fastest_},
                {"pressure_at_end", *std::max_element(p.begin(), p.end())},
                {"underfilled_cells", audit.underfilled_most}};
    if (any_body_moves(model_)) {
      s.maxima["displaced_water"] = audit.displaced;
      s.maxima["body_work"] = audit.body_work;
    }
    if (!model_.changes.empty()) {
      s.maxima["placed_mass"] = audit.solid_in;
      s.maxima["excavated_mass"] = audit.solid_out;
    }
    if (state.soil.size() > 0)
      s.maxima["porosity_at_end"] = *std::max_element(state.soil.porosity.begin(), state.soil.porosity.end());
    for (const Kernel& kernel : kernels) s.kernel_seconds[kernel.key] = state.times.*kernel.seconds;
    s.case_inputs = case_json(model_);
    write_summary(folder_.path() / "summary.json", s);
    log_->info("{}; {} steps in {:.1f} s", s.reason, state.step - start_step_, wall);
  }

  Model model_;
  RunOptions options_;
  std::string case_text_;
  RunFolder folder_;
  std::unique_ptr<Simulation<Space>> simulation_;
  Progress progress_;
  std::shared_ptr<spdlog::logger> log_;
  std::unique_ptr<Monitors<Space>> monitors_;
  std::unique_ptr<HistoryFile> history_;
  VtkSeries series_;
  OutputState output_;
  Summary summary_;
  std::string resumed_from_, refused_;
  double history_interval_ = 0, snapshot_interval_ = 0;  ///< s, of the stage; 0: not begun
  double begin_ = 0, end_ = 0, point_steps_ = 0, fastest_ = 0, start_wall_ = 0;
  std::uint64_t start_step_ = 0;
};

}  // namespace

std::string case_identity(const Model& model) {
  auto json = case_json(model);
  json.erase("file");
  json.erase("name");
  return json.dump();
}

Summary run_case(const Model& model, const RunOptions& options) {
  if (model.space == SpaceKind::solid) return Run<Solid>(model, options).go();
  return Run<PlaneStrain>(model, options).go();
}

}  // namespace polder
