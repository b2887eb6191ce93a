// SPDX-License-Identifier: Apache-2.0
// check_film WIDTH HEIGHT FPS SPEED SAMPLES: finds contacts in a film's decoded pictures (yuv444p
// on the standard input) and onsets in its decoded sound (file SAMPLES: float, mono, 48 kHz), and
// compares them: each contact that rebounds more than 3 pixels has an onset within half a frame of
// 60 a second. It knows nothing of motions and shares no code with the program that made the film.
//
// A contact is a kink: the body's row in the picture falls, then at once rises. The camera stands
// still and looks down, so the row tells of height and depth together; but in flight both change as
// those of a thrown body do, and the row's acceleration is constant but for the mild perspective.
// Only an impact makes the velocity jump, whichever of the two it is in. The instant between two
// pictures is where the parabolas before and after meet. A bounce is compared when the pictures
// tell it: five of flight on either side that lie on the parabolas. Neither rolling nor contacts
// that follow within four pictures have that; slow motion and more frames a second show more of
// them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double kSampleRate = 48000;
constexpr double kLeastRebound = 3;      // pixels: what the eye sees as a bounce
constexpr double kHalfFrame = 0.5 / 60;  // s

// ---- Pictures ----

struct Frame {
  int width = 0, height = 0;
  std::vector<std::uint8_t> planes;  // Y, U, V

  [[nodiscard]] std::size_t pixels() const { return planes.size() / 3; }
  [[nodiscard]] int luma(std::size_t i) const { return planes[i]; }
  [[nodiscard]] int u(std::size_t i) const { return planes[pixels() + i] - 128; }
  [[nodiscard]] int v(std::size_t i) const { return planes[2 * pixels() + i] - 128; }
};

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The picture without the body: each value's median over frames in which the body falls and stays
/// nowhere.
Frame backgroundOf(const std::vector<Frame>& frames) {
  Frame background = frames.front();
  std::vector<std::uint8_t> values(frames.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (std::size_t i = 0; i < background.planes.size(); ++i) {
    for (std::size_t k = 0; k < frames.size(); ++k) values[k] = frames[k].planes[i];
    std::nth_element(values.begin(), middle, values.end());
    background.planes[i] = *middle;
  }
  return background;
}

/// True where something hides the floor: it is brighter, or its chroma is not that of the floor in
/// less light, as a shadow's is.
std::vector<bool> maskOf(const Frame& frame, const Frame& background) {
  constexpr double kNoise = 7;  // of 255: what encoding leaves
  std::vector<bool> mask(frame.pixels());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const double luma = frame.luma(i) - 16, floor = std::max(background.luma(i) - 16, 1);
    const double light = luma / floor, brighter = std::max(luma - floor, 0.0);
    const double apart = std::abs(frame.u(i) - light * background.u(i)) +
                         std::abs(frame.v(i) - light * background.v(i));
    mask[i] = apart + 0.4 * brighter > kNoise;
  }
  return mask;
}

/// A connected piece of the mask.
struct Piece {
  double area = 0, row = 0;  // filled from left to right; its centroid's row
  bool cut = false;          // reaches the picture's edge
};

/// First and last column of a piece on one row.
struct Span {
  double left = 1e9, right = -1;
};

/// Pixels of the piece around `start`, which are taken out of the mask.
std::vector<int> takePixels(std::vector<bool>& mask, int width, int start) {
  std::vector<int> pixels = {start};
  const int count = static_cast<int>(mask.size());
  mask[static_cast<std::size_t>(start)] = false;
  for (std::size_t next = 0; next < pixels.size(); ++next) {
    const int i = pixels[next];
    for (const int other : {i - 1, i + 1, i - width, i + width}) {
      if (other < 0 || other >= count || !mask[static_cast<std::size_t>(other)]) continue;
      mask[static_cast<std::size_t>(other)] = false;
      pixels.push_back(other);
    }
  }
  return pixels;
}

/// Filled from left to right, so that neither pips nor print leave holes.
Piece pieceOf(const std::vector<int>& pixels, int width, int height) {
  std::vector<Span> spans(static_cast<std::size_t>(height));
  for (const int i : pixels) {
    Span& span = spans[static_cast<std::size_t>(i / width)];
    span.left = std::min(span.left, i % width + 0.0);
    span.right = std::max(span.right, i % width + 0.0);
  }
  Piece piece;
  double moment = 0;
  for (int y = 0; y < height; ++y) {
    const Span& span = spans[static_cast<std::size_t>(y)];
    if (span.right < 0) continue;
    const double length = span.right - span.left + 1;
    piece.area += length;
    moment += length * y;
    piece.cut |= span.left == 0 || span.right == width - 1 || y == 0 || y == height - 1;
  }
  piece.row = moment / piece.area;
  return piece;
}

/// Row of the body's centroid, if all of it is in the picture.
std::optional<double> bodyRow(const Frame& frame, const Frame& background) {
  constexpr std::size_t kLeastPixels = 25;
  std::vector<bool> mask = maskOf(frame, background);
  std::vector<int> most;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) continue;
    auto pixels = takePixels(mask, frame.width, static_cast<int>(i));
    if (pixels.size() > most.size()) most = std::move(pixels);
  }
  if (most.size() < kLeastPixels) return {};
  const Piece body = pieceOf(most, frame.width, frame.height);
  if (body.cut) return {};
  return body.row;
}

bool read(Frame& frame) {
  return std::fread(frame.planes.data(), 1, frame.planes.size(), stdin) == frame.planes.size();
}

/// Rows by frame number, from the standard input.
std::vector<std::optional<double>> readRows(int width, int height) {
  constexpr std::size_t kBackgroundFrames = 25;
  Frame frame{width, height, {}};
  frame.planes.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<Frame> first;
  while (first.size() < kBackgroundFrames && read(frame)) first.push_back(frame);
  if (first.empty()) return {};
  const Frame background = backgroundOf(first);
  std::vector<std::optional<double>> rows;
  for (const Frame& early : first) rows.push_back(bodyRow(early, background));
  while (read(frame)) rows.push_back(bodyRow(frame, background));
  return rows;
}
// ---- Contacts ----

/// A kink. Times are frames, velocities rows per frame, downwards positive.
struct Contact {
  double frame = 0;              // of the impact, between pictures
  double row = 0;                // there
  double before = 0, after = 0;  // velocities
  double rebound = 0;            // rows from the impact up to the highest picture that follows
  double residual = 1e9;         // of the fit, rows
  int pictures = 0;              // that the flight before or after has, whichever has fewer

  [[nodiscard]] bool isBounce() const { return before > 0 && after < 0 && rebound > kLeastRebound; }
  /// How well the pictures tell the instant, frames: the scatter about two flights over the jump of
  /// velocity. Large where a body rolls, or where contacts follow each other too fast.
  [[nodiscard]] double blur() const { return residual / std::max(before - after, 1e-9); }
  /// Two pictures fix a parabola of known acceleration; three more tell whether it was one flight.
  /// @param step  pictures in 1/80 s of the motion: the scatter allowed is 0.6 ms of it
  [[nodiscard]] bool isTimed(int step) const { return pictures >= 5 && blur() < 0.05 * step; }
};

class Path {
 public:
  /// @param step  distance of pictures that are compared: more in slow motion, where neighbours
  ///   differ by less than what a body's turning moves its outline
  Path(std::vector<std::optional<double>> rows, int step) : rows_(std::move(rows)), step_(step) {
    for (int k = 0; k < count(); ++k) bends_.push_back(bendAt(k));
    gravity_ = findGravity();
  }

  [[nodiscard]] double gravity() const { return gravity_; }

  /// All kinks, whatever their rebound.
  [[nodiscard]] std::vector<Contact> contacts() const {
    std::vector<Contact> found;
    for (int k = 0; k < count(); ++k) {
      if (isKink(k)) found.push_back({k + 0.0});
    }
    for (int pass = 0; pass < 3; ++pass) {
      const std::vector<Contact> last = found;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const double low = i > 0 ? last[i - 1].frame : -1;
        const double high = i + 1 < last.size() ? last[i + 1].frame : count();
        if (const auto fitted = fit(last[i].frame, low, high)) found[i] = *fitted;
      }
    }
    return found;
  }

 private:
  [[nodiscard]] int count() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] std::optional<double> row(int k) const {
    return k < 0 || k >= count() ? std::nullopt : rows_[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] std::optional<double> bend(int k) const {
    return k < 0 || k >= count() ? std::nullopt : bends_[static_cast<std::size_t>(k)];
  }
  /// Change of velocity around picture k, rows per frame^2.
  [[nodiscard]] std::optional<double> bendAt(int k) const {
    const auto before = row(k - step_), here = row(k), after = row(k + step_);
    if (!before || !here || !after) return {};
    return (*after - 2 * *here + *before) / (step_ * step_);
  }

  /// Acceleration of flight, rows per frame^2: in the inner of flights, over pictures that move.
  [[nodiscard]] double findGravity() const {
    std::vector<double> inner;
    for (int k = 0; k < count(); ++k) {
      const auto before = bend(k - step_), here = bend(k), after = bend(k + step_);
      if (!before || !here || !after || std::min({*before, *here, *after}) <= 0) continue;
      if (*here * step_ * step_ > 1) inner.push_back(*here);
    }
    return medianOf(inner);
  }

  [[nodiscard]] bool isKink(int k) const {
    const auto here = bend(k);
    // The velocity jumps by more than what 3 rows of rebound need, seen half a step away.
    if (!here || *here > gravity_ - 0.4 * std::sqrt(2 * gravity_ * kLeastRebound) / step_) {
      return false;
    }
    for (int other = k - step_; other <= k + step_; ++other) {
      const auto bent = bend(other);
      if (other != k && bent && (*bent < *here || (*bent == *here && other < k))) return false;
    }
    return *here < 0;
  }

  /// Two parabolas of gravity's acceleration that meet, for pictures between two other contacts.
  [[nodiscard]] std::optional<Contact> fit(double near, double low, double high) const {
    constexpr double kGrid = 0.02;
    std::optional<Contact> best;
    const double reach = 6 * step_;
    const int first = static_cast<int>(std::floor(std::max(low, near - reach))) + 1;
    const int last = static_cast<int>(std::ceil(std::min(high, near + reach))) - 1;
    for (double at = near - step_; at <= near + step_; at += kGrid) {
      const auto contact = fitAt(at, first, last);
      if (contact && (!best || contact->residual < best->residual)) best = contact;
    }
    if (!best) return {};
    best->rebound = reboundAfter(best->frame, high);
    return best;
  }

  /// From the lower of the two pictures around an impact to the highest before the next one, rows.
  [[nodiscard]] double reboundAfter(double frame, double next) const {
    const int k = static_cast<int>(std::floor(frame));
    double lowest = std::max(row(k).value_or(0), row(k + 1).value_or(0)), highest = lowest;
    for (int later = k + 1; later < next; ++later) {
      highest = std::min(highest, row(later).value_or(highest));
    }
    return lowest - highest;
  }

  /// Least squares for row and velocities at a given instant.
  [[nodiscard]] std::optional<Contact> fitAt(double at, int first, int last) const {
    std::array<std::array<double, 4>, 3> normal{};
    int before = 0, after = 0;
    double squares = 0;
    for (int k = first; k <= last; ++k) {
      if (!row(k)) continue;
      const double t = k - at, y = *row(k) - gravity_ * t * t / 2;
      const std::array<double, 4> terms = {1, std::min(t, 0.0), std::max(t, 0.0), y};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j) normal[i][j] += terms[i] * terms[j];
      }
      squares += y * y;
      ++(t < 0 ? before : after);
    }
    if (before < 2 || after < 2) return {};
    const auto right = normal;
    const auto solution = solve(normal);
    for (std::size_t i = 0; i < 3; ++i) squares -= solution[i] * right[i][3];
    const double residual = std::sqrt(std::max(squares, 0.0) / (before + after));
    return Contact{at, solution[0], solution[1], solution[2], 0, residual, std::min(before, after)};
  }

  static std::array<double, 3> solve(std::array<std::array<double, 4>, 3> m) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t other = 0; other < 3; ++other) {
        if (other == i) continue;
        const double factor = m[other][i] / m[i][i];
        for (std::size_t j = i; j < 4; ++j) m[other][j] -= factor * m[i][j];
      }
    }
    return {m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
  }

  std::vector<std::optional<double>> rows_;
  int step_;
  std::vector<std::optional<double>> bends_;
  double gravity_ = 0;
};

// ---- Sound ----

std::vector<float> readSamples(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<float> samples(bytes.size() / sizeof(float));
  std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(float));
  return samples;
}

/// Times, s, at which the energy of the next millisecond most exceeds that of the 5 ms before.
std::vector<double> onsetsOf(const std::vector<float>& samples) {
  constexpr std::size_t kNext = 48, kBefore = 240, kApart = 240;
  constexpr double kJump = 6, kFloor = 1e-4;  // of energy; the loudest instant's is 1
  std::vector<double> sum(samples.size() + 1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum[i + 1] = sum[i] + static_cast<double>(samples[i]) * samples[i];
  }
  const auto power = [&](std::size_t from, std::size_t length) {
    return (sum[from + length] - sum[from]) / static_cast<double>(length);
  };
  double loudest = 0;
  for (std::size_t i = 0; i + kNext < samples.size(); ++i) {
    loudest = std::max(loudest, power(i, kNext));
  }
  std::vector<double> jumps(samples.size());
  for (std::size_t i = kBefore; i + kNext < samples.size(); ++i) {
    jumps[i] =
        (power(i, kNext) + kFloor * loudest) / (power(i - kBefore, kBefore) + kFloor * loudest);
  }
  std::vector<double> onsets;
  for (std::size_t i = kApart; i + kApart < jumps.size(); ++i) {
    if (jumps[i] < kJump) continue;
    const auto from = jumps.begin() + static_cast<std::ptrdiff_t>(i - kApart);
    const auto highest = std::max_element(from, from + 2 * kApart + 1);
    if (highest - from == kApart) onsets.push_back(static_cast<double>(i) / kSampleRate);
  }
  return onsets;
}
// ---- Both ----

struct Film {
  int width = 0, height = 0;
  double framesPerSecond = 0, speed = 0;
};

/// Share of the film's busy time, from its first onset to its last, in which any instant has an
/// onset within half a frame: how much agreement would be chance.
double chanceOf(const std::vector<double>& onsets, double half) {
  if (onsets.size() < 2) return 0;
  double covered = 0, last = onsets.front();
  for (const double onset : onsets) {
    covered += std::min(onset + half, onsets.back()) - std::max(onset - half, last);
    last = onset + half;
  }
  return covered / (onsets.back() - onsets.front());
}

double nearest(const std::vector<double>& onsets, double time) {
  return *std::min_element(onsets.begin(), onsets.end(), [&](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
}

/// Prints the table; true when every bounce that pictures can time is heard within half a frame.
bool compare(const std::vector<Contact>& contacts, const std::vector<double>& onsets,
             const Film& film, int step) {
  const double half = kHalfFrame;
  std::vector<double> apart;
  std::size_t bounces = 0;
  std::printf("  frame  instant s  onset s  apart ms  rebound px   blur\n");
  for (const Contact& contact : contacts) {
    bounces += contact.isBounce();
    if (!contact.isBounce() || !contact.isTimed(step)) continue;
    const double time = contact.frame / film.framesPerSecond, onset = nearest(onsets, time);
    apart.push_back(std::abs(onset - time));
    std::printf("  %5ld  %9.4f  %7.4f  %+8.2f  %10.1f  %5.3f%s\n", std::lround(contact.frame), time,
                onset, 1e3 * (onset - time), contact.rebound, contact.blur(),
                apart.back() > half ? "  <- too far" : "");
  }
  const double most = apart.empty() ? 0 : *std::max_element(apart.begin(), apart.end());
  std::printf(
      "  %zu kinks, %zu bounces, %zu timed: at most %.2f ms apart, median %.2f "
      "(half a frame: %.2f; %zu onsets, by chance %.0f %%)\n",
      contacts.size(), bounces, apart.size(), 1e3 * most, 1e3 * medianOf(apart), 1e3 * half,
      onsets.size(), 100 * chanceOf(onsets, half));
  return !apart.empty() && most <= half;
}

int fail(const char* why) {
  std::fprintf(stderr, "check_film: %s\n", why);
  return 1;
}

}  // namespace

int main(int count, char** words) {
  if (count != 6) return fail("give WIDTH HEIGHT FPS SPEED SAMPLES, and pictures on the input");
  const Film film{std::atoi(words[1]), std::atoi(words[2]), std::atof(words[3]),
                  std::atof(words[4])};
  if (film.width < 16 || film.height < 16 || film.framesPerSecond <= 0 || film.speed <= 0) {
    return fail("a size, rate or speed is not one");
  }
  const auto onsets = onsetsOf(readSamples(words[5]));
  if (onsets.empty()) return fail("no onset in the sound");
  const auto rows = readRows(film.width, film.height);
  constexpr double kStepsPerSecond = 80;  // of the motion
  const int step = std::max(
      1, static_cast<int>(std::lround(film.framesPerSecond / film.speed / kStepsPerSecond)));
  const Path path(rows, step);
  if (path.gravity() <= 0) return fail("nothing flies in the pictures");
  if (!compare(path.contacts(), onsets, film, step)) {
    return fail("picture and sound do not agree, or nothing bounces");
  }
  return 0;
}
