// SPDX-License-Identifier: Apache-2.0
// A PNG file read back. Tests that include this link PkgConfig::CAIRO.
#pragma once

#include <cairo/cairo.h>

#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "model/image.h"

namespace ifa::test {

inline Image readPng(const std::filesystem::path& path) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(surface);
    throw std::runtime_error(path.string() + " is no PNG file");
  }
  Image image(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  std::size_t to = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::uint32_t word = 0;
      std::memcpy(&word, data + y * stride + 4 * x, sizeof word);
      for (const int shift : {16, 8, 0}) {
        image.rgb[to++] = static_cast<std::uint8_t>(word >> shift);
      }
    }
  }
  cairo_surface_destroy(surface);
  return image;
}

}  // namespace ifa::test
