#pragma once
// The pictures of a run, pictures/<field>_<time>s.png: the names say what they show, so that a page of them can
// be made from the folder alone.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polder/math/threads.hpp"
#include "polder/result/frame.hpp"
#include "polder/result/picture.hpp"

namespace polder {

struct PictureName {
  std::string field;
  double time = 0;  ///< s
};

/// "porosity_2.5s.png"; the time to six digits.
std::string picture_name(const PictureName& name);
/// Absent where `file` is no such name.
std::optional<PictureName> parse_picture_name(const std::string& file);

/// One picture per field, drawn by all threads, into `folder`/pictures, named by the instant that was asked for (s): a
/// step ends a little later. Fields that the frame does not have are left out. Throws OutputError.
void write_pictures(const std::filesystem::path& folder, const Frame& frame, std::span<const PictureField> fields,
                    double instant, Team& team);

/// The picture files of a run's folder, by field (standard ones first), then by time.
std::vector<std::filesystem::path> list_pictures(const std::filesystem::path& folder);

}  // namespace polder
