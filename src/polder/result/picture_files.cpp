#include "polder/result/picture_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <system_error>
#include <tuple>

#include "polder/result/atomic_file.hpp"
#include "polder/result/paint.hpp"

namespace polder {

std::string picture_name(const PictureName& name) { return fmt::format("{}_{:g}s.png", name.field, name.time); }

std::optional<PictureName> parse_picture_name(const std::string& file) {
  constexpr std::string_view ending = "s.png";
  const std::size_t mark = file.rfind('_');
  if (mark == std::string::npos || mark == 0 || !file.ends_with(ending)) return {};
  const std::string number = file.substr(mark + 1, file.size() - ending.size() - mark - 1);
  char* end = nullptr;
  const double time = std::strtod(number.c_str(), &end);
  if (number.empty() || end != number.c_str() + number.size()) return {};
  return PictureName{file.substr(0, mark), time};
}

void write_pictures(const std::filesystem::path& folder, const Frame& frame, std::span<const PictureField> fields,
                    double instant, Team& team) {
  make_folder(folder / "pictures");
  std::vector<PictureField> shown;
  std::copy_if(fields.begin(), fields.end(), std::back_inserter(shown),
               [&](const PictureField& field) { return frame.soil.find(field.name) || frame.water.find(field.water); });
  std::vector<std::exception_ptr> failures(shown.size());
  team.each(static_cast<std::ptrdiff_t>(shown.size()), [&](std::ptrdiff_t i) {
    try {
      write_drawing(folder / "pictures" / picture_name({shown[i].name, instant}), draw_frame(frame, shown[i]));
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

std::vector<std::filesystem::path> list_pictures(const std::filesystem::path& folder) {
  struct Found {
    std::size_t rank;
    PictureName name;
    std::filesystem::path path;
  };
  std::vector<Found> found;
  std::error_code none;  // a run without pictures has no such folder
  for (const auto& entry : std::filesystem::directory_iterator(folder / "pictures", none)) {
    const auto name = parse_picture_name(entry.path().filename().string());
    if (!name) continue;
    const auto known = std::find(standard_fields.begin(), standard_fields.end(), name->field);
    found.push_back({static_cast<std::size_t>(known - standard_fields.begin()), *name, entry.path()});
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tie(a.rank, a.name.field, a.name.time) < std::tie(b.rank, b.name.field, b.name.time);
  });
  std::vector<std::filesystem::path> paths;
  paths.reserve(found.size());
  for (Found& f : found) paths.push_back(std::move(f.path));
  return paths;
}

}  // namespace polder
