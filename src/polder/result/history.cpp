#include "polder/result/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "polder/result/output_error.hpp"

namespace polder {
namespace {

// RFC 4180: a cell with a comma or a quote is quoted, quotes are doubled.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c == '\n' ? ' ' : c);
  return quoted + "\"";
}

std::string header(const std::vector<HistoryColumn>& columns) {
  std::string line = "time [s]";
  for (const HistoryColumn& column : columns)
    line += "," + cell(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  return line + "\n";
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"')
        result.back() += line[i++];
      else
        quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      result.emplace_back();
    } else {
      result.back() += line[i];
    }
  }
  return result;
}

HistoryColumn column_of(const std::string& heading) {
  const std::size_t bracket = heading.rfind(" [");
  if (bracket == std::string::npos || heading.back() != ']') return {heading, ""};
  return {heading.substr(0, bracket), heading.substr(bracket + 2, heading.size() - bracket - 3)};
}

double number(const std::string& text) {
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::size_t used = 0;
  const double value = std::stod(text, &used);
  if (used != text.size()) throw std::invalid_argument(text);
  return value;
}

}  // namespace

HistoryFile::HistoryFile(std::filesystem::path path, const std::vector<HistoryColumn>& columns)
    : path_(std::move(path)), columns_(columns.size()) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw OutputError(path_.string(), std::generic_category().message(errno));
  write(header(columns));
}

HistoryFile::HistoryFile(std::filesystem::path path, const std::vector<HistoryColumn>& columns, std::size_t rows)
    : path_(std::move(path)), columns_(columns.size()), rows_(rows) {
  const std::string text = contents(path_), first = header(columns);
  if (text.compare(0, first.size(), first) != 0)
    throw OutputError(path_.string(), "it has other columns than this run, so that it cannot be continued");
  std::size_t end = first.size();
  for (std::size_t row = 0; row < rows; ++row) {
    end = text.find('\n', end);
    if (end == std::string::npos)
      throw OutputError(path_.string(),
                        fmt::format("it has {} rows, but the checkpoint was taken after {}", row, rows));
    ++end;
  }
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0 || ::ftruncate(descriptor_, static_cast<off_t>(end)) != 0)
    throw OutputError(path_.string(), std::generic_category().message(errno));
}

HistoryFile::~HistoryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void HistoryFile::append(double time, std::span<const double> values) {
  if (values.size() != columns_) throw std::logic_error("history: a row has another number of values than columns");
  std::string line = fmt::format("{}", time);
  for (const double value : values) line += fmt::format(",{}", value);
  write(line + "\n");
  ++rows_;
}

void HistoryFile::write(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(descriptor_, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw OutputError(path_.string(), std::generic_category().message(errno));
    done += static_cast<std::size_t>(count);
  }
}

History read_history(const std::filesystem::path& path) {
  std::string text = contents(path);
  text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  History history;
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::vector<std::string> row = cells(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    if (++line_number == 1) {
      for (const std::string& heading : row) history.columns.push_back(column_of(heading));
      history.values.resize(row.size());
      continue;
    }
    const auto where = [&] { return path.string() + ", line " + std::to_string(line_number) + ": "; };
    if (row.size() != history.columns.size())
      throw std::runtime_error(where() + fmt::format("{} values for {} columns", row.size(), history.columns.size()));
    try {
      for (std::size_t c = 0; c < row.size(); ++c) history.values[c].push_back(number(row[c]));
    } catch (const std::logic_error&) {
      throw std::runtime_error(where() + "a value is not a number");
    }
  }
  if (line_number == 0) throw std::runtime_error(path.string() + ": there is no complete history in this file");
  return history;
}

}  // namespace polder
