// SPDX-License-Identifier: Apache-2.0
// Lines and letters on a picture, and pictures as PNG files: the façade of Cairo.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ifa/result.h"
#include "model/image.h"

namespace ifa::render {

/// A colour of the screen, 0 to 1, and how much it covers.
struct Paint {
  double red = 1, green = 1, blue = 1, alpha = 1;
};

enum class Align { kLeft, kMiddle, kRight };

/// Draws on rows `top` to `top + height` of a picture. Coordinates are in pixels from the picture's
/// upper left corner.
class Canvas {
 public:
  explicit Canvas(Image& image) : Canvas(image, 0, image.height) {}
  Canvas(Image& image, int top, int height);
  /// Puts what was drawn into the picture.
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void rectangle(double x, double y, double width, double height, const Paint& paint);
  void disc(double x, double y, double radius, const Paint& paint);
  /// Vertical lines one pixel wide from low[i] to high[i] at x + i.
  void bars(double x, const std::vector<float>& low, const std::vector<float>& high,
            const Paint& paint);
  /// @param y  of the line on which letters stand
  void text(double x, double y, double size, Align align, const std::string& text,
            const Paint& paint);
  [[nodiscard]] double textWidth(double size, const std::string& text);

 private:
  struct Surface;
  Image& image_;
  std::unique_ptr<Surface> surface_;
};

/// Atomic. Errors: kBadInput when the file cannot be written.
[[nodiscard]] Result<void> writePng(const std::filesystem::path& path, const Image& image);

}  // namespace ifa::render
