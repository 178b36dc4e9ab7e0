#pragma once
// history.csv: one row per output interval, time first, then every monitor; the header names quantity and unit.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace polder {

struct HistoryColumn {
  std::string name;  ///< "crest settlement"
  std::string unit;  ///< "m"; empty: a pure number
};

/// An open history.csv. A row reaches the file in one piece before `append` returns, so that a kill leaves whole rows
/// and a reader may follow the run. Values are written with the fewest digits that read back to the same number.
class HistoryFile {
 public:
  /// Starts an empty history. `columns` come after the time. Throws OutputError.
  HistoryFile(std::filesystem::path path, const std::vector<HistoryColumn>& columns);
  /// Continues an existing one after its first `rows` rows; later ones are cut off. Throws OutputError where the file
  /// has other columns or fewer rows.
  HistoryFile(std::filesystem::path path, const std::vector<HistoryColumn>& columns, std::size_t rows);
  ~HistoryFile();
  HistoryFile(const HistoryFile&) = delete;
  HistoryFile& operator=(const HistoryFile&) = delete;

  /// `time` in s, and one value per column. Throws OutputError.
  void append(double time, std::span<const double> values);
  std::size_t rows() const { return rows_; }

 private:
  void write(const std::string& text);
  std::filesystem::path path_;
  std::size_t columns_ = 0, rows_ = 0;
  int descriptor_ = -1;
};

/// A history read back: columns[0] is the time.
struct History {
  std::vector<HistoryColumn> columns;
  std::vector<std::vector<double>> values;  ///< per column

  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
};

/// Reads what HistoryFile wrote; a last line without its end (a run that is writing) is left out. Throws
/// std::runtime_error with the line where the file is not such a table.
History read_history(const std::filesystem::path& path);

}  // namespace polder
