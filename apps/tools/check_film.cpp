// SPDX-License-Identifier: Apache-2.0
// check_film WIDTH HEIGHT FPS SPEED LEAST SAMPLES: finds contacts in a film's decoded pictures
// (yuv444p on the standard input) and onsets in its decoded sound (file SAMPLES: float, mono, 48
// kHz), and compares them: every contact that rebounds more than 3 pixels, and there are at least
// LEAST, has an onset of its own within half a frame of 60 a second, in the motion's time. It knows
// nothing of motions and shares no code with the program that made the film.
//
// The film is one of `--camera low`: the eye is at the floor, so that all of the floor is seen in
// one row, the horizon, and rows above it tell how high the lowest point of the outline is, however
// far the body. A body that touches the floor touches the horizon; one that rolls, rocks or slides
// stays there, and only one that bounces leaves it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace {

constexpr double kSampleRate = 48000;
constexpr double kLeastRebound = 3;      // pixels: what the eye sees as a bounce
constexpr double kHalfFrame = 0.5 / 60;  // s
constexpr double kMergeGap = 0.01;       // s: touches that are closer are one contact
constexpr double kMoved = 0.02;          // s: what must be noticed when the sound comes off so much

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// ---- Pictures ----

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> planes;  // Y, U, V

  [[nodiscard]] const std::uint8_t* row(int plane, int y) const {
    return planes.data() + static_cast<std::ptrdiff_t>(plane * height + y) * width;
  }
  /// The row's colour where no body is: the backdrop is the same all along it.
  [[nodiscard]] int backdrop(int plane, int y) const {
    std::vector<std::uint8_t> values(row(plane, y), row(plane, y) + width);
    const auto middle = values.begin() + width / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }
};

/// First row of the floor: where the backdrop ends.
int horizonOf(const Picture& picture) {
  int horizon = 0, most = 0;
  for (int y = picture.height / 2; y + 1 < picture.height; ++y) {
    const int jump = std::abs(picture.backdrop(0, y + 1) - picture.backdrop(0, y));
    if (jump <= most) continue;
    most = jump;
    horizon = y + 1;
  }
  return horizon;
}

/// True when something other than the backdrop is seen in the row.
bool holdsBody(const Picture& picture, int y) {
  constexpr int kNoise = 20;       // of 3 * 255: more than what encoding leaves
  constexpr int kLeastPixels = 2;  // a corner that points down is about as wide
  std::vector<int> apart(static_cast<std::size_t>(picture.width));
  for (int plane = 0; plane < 3; ++plane) {
    const int backdrop = picture.backdrop(plane, y);
    const std::uint8_t* row = picture.row(plane, y);
    for (std::size_t x = 0; x < apart.size(); ++x) apart[x] += std::abs(row[x] - backdrop);
  }
  return std::count_if(apart.begin(), apart.end(), [](int a) { return a > kNoise; }) >=
         kLeastPixels;
}

/// Height of the outline's lowest row over the horizon, if there is a body.
std::optional<int> heightIn(const Picture& picture, int horizon) {
  for (int y = horizon - 1; y >= 0; --y) {
    if (holdsBody(picture, y)) return horizon - 1 - y;
  }
  return {};
}

/// Heights by frame number, from the standard input.
std::vector<std::optional<int>> readHeights(int width, int height) {
  Picture picture{width, height, {}};
  picture.planes.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<std::optional<int>> heights;
  int horizon = 0;
  while (std::fread(picture.planes.data(), 1, picture.planes.size(), stdin) ==
         picture.planes.size()) {
    if (heights.empty()) horizon = horizonOf(picture);
    heights.push_back(heightIn(picture, horizon));
  }
  return heights;
}

// ---- Contacts ----

/// The body at the floor. Numbers of pictures.
struct Contact {
  int first = 0, last = 0;
  int rebound = 0;  // pixels: how high the lowest point is before the next contact
};

class Path {
 public:
  explicit Path(std::vector<std::optional<int>> heights) : heights_(std::move(heights)) {}

  /// Touches that are less than the merge gap apart are one contact.
  /// @param gap  pictures
  [[nodiscard]] std::vector<Contact> contacts(double gap) const {
    std::vector<Contact> found;
    for (int k = 1; k < count(); ++k) {
      const int last = endOfLevel(k);
      if (!isTouch(k, last)) continue;
      const int first = firstWithinAPixel(k);
      if (found.empty() || first - found.back().last >= gap) found.push_back({first});
      found.back().last = k = last;
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      const int next = i + 1 < found.size() ? found[i + 1].first : count();
      for (int k = found[i].first; k < next; ++k) {
        found[i].rebound = std::max(found[i].rebound, height(k).value_or(0));
      }
    }
    return found;
  }

  /// True when the body is seen in every picture from k on and ends on the horizon.
  [[nodiscard]] bool staysFrom(int k) const {
    return heights_.back().value_or(2) <= 1 &&
           std::all_of(heights_.begin() + k, heights_.end(), [](auto h) { return h.has_value(); });
  }

 private:
  [[nodiscard]] int count() const { return static_cast<int>(heights_.size()); }
  [[nodiscard]] std::optional<int> height(int k) const {
    return k < 0 || k >= count() ? std::nullopt : heights_[static_cast<std::size_t>(k)];
  }
  /// Last picture of those from k on that are as high as k.
  [[nodiscard]] int endOfLevel(int k) const {
    while (k + 1 < count() && height(k + 1) == height(k)) ++k;
    return k;
  }
  /// What touches the floor between two pictures falls and rises in straight lines that meet there,
  /// at most half a picture away from the lower one: that is then at most a quarter as high as its
  /// two neighbours together. A corner that swings past in flight makes a round valley instead. A
  /// height is counted in whole rows, and is less than a row more.
  [[nodiscard]] bool isTouch(int first, int last) const {
    const auto before = height(first - 1), here = height(first), after = height(last + 1);
    if (!before || !here || *before <= *here) return false;
    if (!after) return last + 1 == count() && *here <= 1;  // it lies there in the end
    return *after > *here && *before + 1 + *after + 1 > 4 * *here;
  }
  /// First of the pictures up to k that are lower than a pixel and a half over it.
  [[nodiscard]] int firstWithinAPixel(int k) const {
    const int here = height(k).value_or(0);
    while (height(k - 1).value_or(here + 2) <= here + 1) --k;
    return k;
  }

  std::vector<std::optional<int>> heights_;
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
  std::size_t least = 1;  // bounces that are expected at least
};

double nearest(const std::vector<double>& onsets, double time) {
  return *std::min_element(onsets.begin(), onsets.end(), [&](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
}

/// A contact that rebounds, beside the onset that is nearest to its first picture.
struct Bounce {
  Contact contact;
  double time = 0, onset = 0;  // s of the film
  double apart = 0;            // s of the motion; positive: the onset is late
  bool shared = false;         // the bounce before has the same onset

  [[nodiscard]] bool isHeard() const { return std::abs(apart) <= kHalfFrame && !shared; }
};

/// @param late  s of the motion by which the sound is moved
std::vector<Bounce> bouncesOf(const std::vector<Contact>& contacts,
                              const std::vector<double>& onsets, const Film& film, double late) {
  std::vector<Bounce> bounces;
  for (const Contact& contact : contacts) {
    if (contact.rebound <= kLeastRebound) continue;
    const double time = contact.first / film.framesPerSecond, move = late / film.speed;
    const double onset = nearest(onsets, time - move) + move;
    const bool shared = !bounces.empty() && bounces.back().onset == onset;
    bounces.push_back({contact, time, onset, film.speed * (onset - time), shared});
  }
  return bounces;
}

long countUnheard(const std::vector<Bounce>& bounces) {
  return std::count_if(bounces.begin(), bounces.end(),
                       [](const Bounce& b) { return !b.isHeard(); });
}

void print(const std::vector<Bounce>& bounces) {
  std::printf("  picture  instant s  onset s  apart ms  rebound px\n");
  for (const Bounce& bounce : bounces) {
    std::printf("  %7d  %9.4f  %7.4f  %+8.2f  %10d%s\n", bounce.contact.first, bounce.time,
                bounce.onset, 1e3 * bounce.apart, bounce.contact.rebound,
                bounce.isHeard() ? "" : "  <- no onset of its own");
  }
}

/// Prints the table; true when all bounces are heard within half a frame, each by itself, and
/// would not be if the sound came earlier or later.
bool compare(const std::vector<Contact>& contacts, const std::vector<double>& onsets,
             const Film& film) {
  const auto bounces = bouncesOf(contacts, onsets, film, 0);
  print(bounces);
  std::vector<double> apart;
  for (const Bounce& bounce : bounces) apart.push_back(std::abs(bounce.apart));
  const double most = apart.empty() ? 0 : *std::max_element(apart.begin(), apart.end());
  const long early = countUnheard(bouncesOf(contacts, onsets, film, -kMoved));
  const long late = countUnheard(bouncesOf(contacts, onsets, film, kMoved));
  std::printf("  %zu contacts, %zu bounces, all compared: at most %.2f ms apart, median %.2f\n",
              contacts.size(), bounces.size(), 1e3 * most, 1e3 * medianOf(apart));
  std::printf("  %zu onsets; had the sound come %.0f ms earlier, %ld would differ, later %ld\n",
              onsets.size(), 1e3 * kMoved, early, late);
  if (bounces.size() < film.least) std::printf("  fewer bounces than %zu\n", film.least);
  return bounces.size() >= film.least && countUnheard(bounces) == 0 && early > 0 && late > 0;
}

int fail(const char* why) {
  std::fprintf(stderr, "check_film: %s\n", why);
  return 1;
}

}  // namespace

int main(int count, char** words) {
  if (count != 7) return fail("give WIDTH HEIGHT FPS SPEED LEAST SAMPLES, pictures on the input");
  const Film film{std::atoi(words[1]), std::atoi(words[2]), std::atof(words[3]),
                  std::atof(words[4]), std::strtoul(words[5], nullptr, 10)};
  if (film.width < 16 || film.height < 16 || film.framesPerSecond <= 0 || film.speed <= 0 ||
      film.least < 1) {
    return fail("a size, rate, speed or number is not one");
  }
  const auto onsets = onsetsOf(readSamples(words[6]));
  if (onsets.empty()) return fail("no onset in the sound");
  const Path path(readHeights(film.width, film.height));
  const auto contacts = path.contacts(kMergeGap * film.framesPerSecond / film.speed);
  if (contacts.empty() || !path.staysFrom(contacts.front().first)) {
    return fail("the body leaves the picture, or does not rest on the horizon in the end");
  }
  if (!compare(contacts, onsets, film)) {
    return fail("picture and sound do not agree, or too few bounces");
  }
  return 0;
}
