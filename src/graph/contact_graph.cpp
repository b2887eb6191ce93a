// SPDX-License-Identifier: Apache-2.0
#include "graph/contact_graph.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "graph/best_list.h"
#include "graph/event_tree.h"
#include "graph/tree_events.h"

namespace ifa {

struct ContactGraph::Parts {
  Parts(EventDatabase from, const Body& of, const GraphSettings& how, EventTree onwardTree,
        EventTree endingTree, SymmetryGroup group)
      : database(std::move(from)),
        body(of),
        settings(how),
        onward(std::move(onwardTree)),
        ending(std::move(endingTree)),
        symmetry(std::move(group)),
        folding(symmetry) {
    for (std::size_t i = 0; i < symmetry.order(); ++i) {
      images.push_back(SymmetryImage::of(symmetry.elements()[i]));
      undoing.push_back(symmetry.inverse(i));
    }
  }

  /// The source as the image of an event under `element` sees it: the image is like the source
  /// where the event is like this.
  [[nodiscard]] TransitionSource seenFrom(const TransitionSource& source,
                                          std::size_t element) const {
    const SymmetryImage& image = images[undoing[element]];
    return {image.apply(source.before), image.apply(source.after)};
  }
  /// For every element.
  [[nodiscard]] std::vector<TransitionSource> seenFromAll(const TransitionSource& source) const {
    std::vector<TransitionSource> all;
    for (std::size_t i = 0; i < images.size(); ++i) all.push_back(seenFrom(source, i));
    return all;
  }

  EventDatabase database;
  Body body;
  GraphSettings settings;
  EventTree onward, ending;
  SymmetryGroup symmetry;
  Folding folding;
  std::vector<SymmetryImage> images;  ///< of the group's elements
  std::vector<std::size_t> undoing;   ///< their inverses
};

ContactGraph::ContactGraph(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
ContactGraph::ContactGraph(ContactGraph&&) noexcept = default;
ContactGraph& ContactGraph::operator=(ContactGraph&&) noexcept = default;
ContactGraph::~ContactGraph() = default;

Result<ContactGraph> ContactGraph::make(EventDatabase database, const Body& body,
                                        const GraphSettings& settings, const Progress& progress) {
  if (auto same = database.checkBody(body); !same) return tl::unexpected(same.error());
  if (database.events() > std::numeric_limits<std::uint32_t>::max() - 1)
    return badInput("has too many events to search", database.path().string());
  progress("index", 0);
  SymmetryGroup symmetry = settings.symmetry ? findSymmetry(body) : SymmetryGroup();
  auto events = treeEvents(database, symmetry, progress);
  if (!events) return tl::unexpected(events.error());
  progress("index", 0.2);
  const TreeScales scales = treeScales(database, settings.affinity);
  EventTree onward(std::move(events->onward), scales);
  progress("index", 0.9);
  EventTree ending(std::move(events->ending), scales);
  progress("index", 1);
  return ContactGraph(std::make_unique<Parts>(std::move(database), body, settings,
                                              std::move(onward), std::move(ending),
                                              std::move(symmetry)));
}

const EventTree& ContactGraph::tree(bool terminal) const {
  return terminal ? parts_->ending : parts_->onward;
}

std::vector<Transition> ContactGraph::best(const TransitionSource& source,
                                           const TransitionTarget& target,
                                           std::size_t count) const {
  if (!(target.time > 0) || count == 0) return {};
  const Parts& p = *parts_;
  const EventTree& tree = target.terminal ? p.ending : p.onward;
  const std::vector<TransitionSource> sources = p.seenFromAll(source);
  std::vector<TreeQuery> queries;
  for (const TransitionSource& seen : sources)
    queries.emplace_back(p.body, p.settings, seen, target);
  auto finds = tree.find(queries, count, p.settings.mostLeaves);
  // Equal weights keep the order of their events.
  std::sort(finds.begin(), finds.end(),
            [](const TreeFind& a, const TreeFind& b) { return a.sibling < b.sibling; });
  BestList<Transition> best(count);
  for (const TreeFind& find : finds) {
    // The tree has an image of the event; the query found an image of that.
    const std::size_t fold = p.folding.elementOf(p.database, find.sibling);
    const std::size_t element = p.symmetry.product(fold, find.query);
    const EdgeWeight weight =
        EdgeWeigher(p.database, p.body, p.settings, sources[element], target).weigh(find.sibling);
    if (weight.exists())
      best.add({find.sibling, weight, weight.total(), static_cast<std::uint32_t>(element)});
  }
  return best.take();
}

std::vector<Transition> ContactGraph::bestByScan(const TransitionSource& source,
                                                 const TransitionTarget& target,
                                                 std::size_t count) const {
  const Parts& p = *parts_;
  const std::vector<TransitionSource> sources = p.seenFromAll(source);
  std::vector<EdgeWeigher> weighers;
  for (const TransitionSource& seen : sources)
    weighers.emplace_back(p.database, p.body, p.settings, seen, target);
  BestList<Transition> best(count);
  for (std::uint32_t j = 0; j < p.database.events(); ++j) {
    std::optional<Transition> edge;
    for (std::uint32_t image = 0; image < weighers.size(); ++image) {
      const EdgeWeight weight = weighers[image].weigh(j, edge ? edge->total : best.least());
      if (weight.exists() && !(edge && weight.total() <= edge->total))
        edge = {j, weight, weight.total(), image};
    }
    if (edge) best.add(*edge);
  }
  return best.take();
}

EdgeWeight ContactGraph::edgeWeight(const TransitionSource& source, const TransitionTarget& target,
                                    std::uint32_t sibling, std::size_t symmetry) const {
  const Parts& p = *parts_;
  const TransitionSource seen = p.seenFrom(source, symmetry);
  return EdgeWeigher(p.database, p.body, p.settings, seen, target).weigh(sibling);
}

EdgeWeight ContactGraph::silentWeight(const TransitionTarget& target, std::uint32_t event) const {
  return ifa::silentWeight(parts_->database, parts_->settings, target, event);
}

std::vector<PathStart> ContactGraph::bestStarts(double time, const HeardEvent& first,
                                                const TransitionTarget& second,
                                                std::size_t count) const {
  const Parts& p = *parts_;
  const auto flags = p.database.flags();
  const auto durations = p.database.values(kDuration), gaps = p.database.values(kGap);
  const HeardEvent itself = {1, first.duration, first.centroid};
  BestList<PathStart> best(count);
  for (std::uint32_t j = 0; j < p.database.events(); ++j) {
    PathStart start{j, time - durations[j], {}, {}, 0};
    if (!(start.time > 0) || !(gaps[j] > 0) || (flags[j] & EventRecord::kFollowed) == 0) continue;
    if (logTimeWarp(start.time, gaps[j], p.settings.affinity) < best.least()) continue;
    const double measure = p.database.values(kAmplitude)[j];
    const HeardEvent event = heardEvent(p.database, j, measure);
    start.sound.sound = logDuration(itself, event, p.settings.affinity) +
                        logCentroid(itself, event, p.settings.affinity);
    if (start.sound.sound < best.least() || !(measure > 0)) continue;
    const TransitionSource source = {this->event(j).before, this->event(j).after};
    const TransitionTarget target = {start.time, second.heard, second.terminal, measure};
    start.weight = isLeftInSilence(flags, j)
                       ? silentWeight(target, j)
                       : EdgeWeigher(p.database, p.body, p.settings, source, target)
                             .weigh(j, best.least() - start.sound.sound);
    start.total = start.sound.sound + start.weight.total();
    if (start.weight.exists()) best.add(start);
  }
  return best.take();
}

std::vector<PathEnd> ContactGraph::bestAlone(const HeardEvent& heard, bool terminal,
                                             std::size_t count) const {
  const Parts& p = *parts_;
  const auto flags = p.database.flags();
  BestList<PathEnd> best(count);
  for (std::uint32_t i = 0; i < p.database.events(); ++i) {
    if (((flags[i] & EventRecord::kTerminal) != 0) != terminal) continue;
    const HeardEvent event = heardEvent(p.database, i, 1);
    best.add({i, logDuration(heard, event, p.settings.affinity) +
                     logCentroid(heard, event, p.settings.affinity)});
  }
  return best.take();
}

ContactEvent ContactGraph::event(std::uint32_t event) const {
  const EventRecord record = parts_->database.record(event);
  ContactEvent made;
  made.end = record.duration;
  made.amplitude = record.amplitude;
  made.centroid = record.centroid;
  made.terminal = record.has(EventRecord::kTerminal);
  made.before = unpack(record.before);
  made.after = unpack(record.after);
  made.after.position.x() = record.shift[0];
  made.after.position.y() = record.shift[1];
  made.touchingAfter = record.has(EventRecord::kTouchingAfter);
  return made;
}

std::pair<ContactEvent, ContactEvent> ContactGraph::passage(std::uint32_t sibling) const {
  const EventRecord record = parts_->database.record(sibling);
  ContactEvent first = event(sibling), second = event(sibling + 1);
  second.start += first.end + record.gap;
  second.end += first.end + record.gap;
  for (RigidState* state : {&second.before, &second.after})
    state->position += Eigen::Vector3d(record.next[0], record.next[1], 0);
  // A touch too soft to hear makes the way there no flight either.
  first.touchingAfter = first.touchingAfter || record.has(EventRecord::kSilentPassage);
  return {first, second};
}

HeardEvent ContactGraph::heard(std::uint32_t event, double firstAmplitude) const {
  return heardEvent(parts_->database, event, firstAmplitude);
}

const EventDatabase& ContactGraph::database() const { return parts_->database; }
const GraphSettings& ContactGraph::settings() const { return parts_->settings; }
const SymmetryGroup& ContactGraph::symmetry() const { return parts_->symmetry; }
const SymmetryImage& ContactGraph::image(std::size_t element) const {
  return parts_->images[element];
}
std::size_t ContactGraph::indexBytes() const {
  return parts_->onward.bytes() + parts_->ending.bytes();
}

}  // namespace ifa
