// SPDX-License-Identifier: Apache-2.0
#include "render/canvas.h"

#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/file.h"

namespace ifa::render {
namespace {

constexpr const char* kTypeface = "DejaVu Sans";

/// Cairo's pixels are words of four bytes: 0, red, green, blue from the highest.
void toWords(const std::uint8_t* rgb, std::uint32_t* words, int count) {
  for (int i = 0; i < count; ++i, rgb += 3) {
    words[i] = static_cast<std::uint32_t>(rgb[0] << 16 | rgb[1] << 8 | rgb[2]);
  }
}

void fromWords(const std::uint32_t* words, std::uint8_t* rgb, int count) {
  for (int i = 0; i < count; ++i, rgb += 3) {
    rgb[0] = static_cast<std::uint8_t>(words[i] >> 16);
    rgb[1] = static_cast<std::uint8_t>(words[i] >> 8);
    rgb[2] = static_cast<std::uint8_t>(words[i]);
  }
}

/// The words of a surface's row.
std::uint32_t* wordsOf(cairo_surface_t* surface, int row) {
  return reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface) +
                                          std::ptrdiff_t{row} *
                                              cairo_image_surface_get_stride(surface));
}

std::size_t offsetOf(const Image& image, int row) {
  return 3 * static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width);
}

/// A new surface that shows rows `top` to `top + rows` of the picture.
cairo_surface_t* surfaceOf(const Image& image, int top, int rows) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, rows);
  cairo_surface_flush(surface);
  for (int y = 0; y < rows; ++y) {
    toWords(image.rgb.data() + offsetOf(image, top + y), wordsOf(surface, y), image.width);
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

}  // namespace

/// Part of a picture in Cairo's hands.
struct Canvas::Surface {
  Surface(const Image& image, int firstRow, int rows)
      : top(firstRow),
        height(rows),
        surface(surfaceOf(image, firstRow, rows)),
        context(cairo_create(surface)) {
    cairo_translate(context, 0, -top);
    cairo_select_font_face(context, kTypeface, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  }
  ~Surface() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  void copyTo(Image& image) const {
    cairo_surface_flush(surface);
    for (int y = 0; y < height; ++y) {
      fromWords(wordsOf(surface, y), image.rgb.data() + offsetOf(image, top + y), image.width);
    }
  }
  void use(const Paint& paint) const {
    cairo_set_source_rgba(context, paint.red, paint.green, paint.blue, paint.alpha);
  }

  int top, height;
  cairo_surface_t* surface;
  cairo_t* context;
};

Canvas::Canvas(Image& image, int top, int height)
    : image_(image), surface_(std::make_unique<Surface>(image, top, height)) {}

Canvas::~Canvas() { surface_->copyTo(image_); }

void Canvas::rectangle(double x, double y, double width, double height, const Paint& paint) {
  surface_->use(paint);
  cairo_rectangle(surface_->context, x, y, width, height);
  cairo_fill(surface_->context);
}

void Canvas::disc(double x, double y, double radius, const Paint& paint) {
  surface_->use(paint);
  cairo_new_path(surface_->context);
  cairo_arc(surface_->context, x, y, radius, 0, 6.283185307179586);
  cairo_fill(surface_->context);
}

void Canvas::bars(double x, const std::vector<float>& low, const std::vector<float>& high,
                  const Paint& paint) {
  surface_->use(paint);
  for (std::size_t i = 0; i < low.size(); ++i) {
    const auto from = static_cast<double>(low[i]), to = static_cast<double>(high[i]);
    cairo_rectangle(surface_->context, x + static_cast<double>(i), std::min(from, to), 1,
                    std::abs(to - from));
  }
  cairo_fill(surface_->context);
}

void Canvas::text(double x, double y, double size, Align align, const std::string& text,
                  const Paint& paint) {
  surface_->use(paint);
  const double width = align == Align::kLeft ? 0 : textWidth(size, text);
  cairo_set_font_size(surface_->context, size);
  cairo_move_to(surface_->context, x - (align == Align::kMiddle ? 0.5 * width : width), y);
  cairo_show_text(surface_->context, text.c_str());
}

double Canvas::textWidth(double size, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_set_font_size(surface_->context, size);
  cairo_text_extents(surface_->context, text.c_str(), &extents);
  return extents.x_advance;
}

Result<void> writePng(const std::filesystem::path& path, const Image& image) {
  cairo_surface_t* surface = surfaceOf(image, 0, image.height);
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface, append, &bytes);
  cairo_surface_destroy(surface);
  if (status != CAIRO_STATUS_SUCCESS) {
    return tl::unexpected<Error>(
        {ErrorCode::kInternal, cairo_status_to_string(status), path.string(), {}});
  }
  return writeFileAtomically(path, bytes);
}

}  // namespace ifa::render
