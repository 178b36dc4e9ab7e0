#pragma once
// Pictures of a frame: the points, about the size of what they stand for, coloured by one quantity, with scales in
// metres, a colour bar, the outline at the start, walls and the free surface. In 3d the picture is the section through
// the middle of the model across its depth.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polder/result/drawing.hpp"
#include "polder/result/frame.hpp"
#include "polder/result/ticks.hpp"

namespace polder {

/// What a picture shows.
struct PictureField {
  std::string name;   ///< of the soil's field; vectors are shown by their magnitude
  std::string water;  ///< of the water's field on the same scale; empty: water in one pale blue
  ColourMap map = ColourMap::field;
  std::optional<Range> range;  ///< SI; absent: round numbers that hold the values
  bool from_zero = false;      ///< an automatic range starts at zero
};

/// The usual way to show a field, by its name.
PictureField picture_field(std::string_view name);

/// The quantities that pictures show unless told otherwise.
inline constexpr std::array<std::string_view, 5> standard_fields{"porosity", "pore_pressure", "deviatoric_strain",
                                                                 "displacement", "velocity"};

/// Those of `standard_fields` that the frame has.
std::vector<PictureField> standard_pictures(const Frame& frame);

struct PictureStyle {
  double width = 960;                        ///< drawing units; a PNG has twice as many pixels
  double max_height = 720;                   ///< of the panel; a tall model makes a narrower picture
  std::optional<std::array<Range, 2>> view;  ///< m; absent: the width of the model, up to its highest point
  bool outline = true;
  bool scale_bar = false;  ///< a bar of a round length in the panel's upper right corner, as publications ask for
};

/// The range that a picture of these frames would choose; one range for several pictures makes them comparable. Throws
/// std::invalid_argument where no frame has the field.
Range common_range(std::span<const Frame> frames, const PictureField& field);

/// One picture. Throws std::invalid_argument where neither soil nor water has the field.
Drawing draw_frame(const Frame& frame, const PictureField& field, const PictureStyle& style = {});

/// Several instants (rows) of several quantities (columns), each column on one scale. At least one of both.
Drawing draw_sheet(std::span<const Frame> frames, std::span<const PictureField> fields, const PictureStyle& style = {});

}  // namespace polder
