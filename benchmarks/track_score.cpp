// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "track_score.h"

#include <algorithm>
#include <cmath>

#include "pipeline/track/assignment.h"

namespace pcl_bv::bench {
using namespace detail;

std::vector<std::pair<std::size_t, std::size_t>> TrackScore::add(const std::vector<TrueObject>& truths,
                                                                 const std::vector<FoundObject>& found) {
  Frame& frame = frames_.emplace_back();
  for (const TrueObject& truth : truths)
    frame.truths.emplace_back(sequence_, truth.id);
  std::vector<std::pair<std::size_t, std::size_t>> matches;
  for (std::size_t f = 0; f < found.size(); ++f) {
    bool matched = false;
    const Key track(sequence_, found[f].track);
    std::vector<Pair> pairs;
    for (const auto& [t, both] : found[f].shared) {
      const double similarity =
          static_cast<double>(both) / static_cast<double>(truths[t].points + found[f].points - both);
      pairs.push_back({frame.truths[t], track, similarity});
      if (similarity <= 0.5) continue;
      matches.emplace_back(t, f);
      matched = true;
    }
    if (found[f].other && !matched) continue;
    frame.tracks.push_back(track);
    frame.pairs.insert(frame.pairs.end(), pairs.begin(), pairs.end());
  }
  std::sort(matches.begin(), matches.end());
  std::set<Key> seen;
  for (const auto& [t, f] : matches) {
    const Key& truth = frame.truths[t];
    const auto [last, first] = last_.try_emplace(truth, found[f].track);
    sums_.switches += last->second != found[f].track;
    sums_.fragments += !first && lost_.count(truth) != 0;
    last->second = found[f].track;
    seen.insert(truth);
  }
  for (const Key& truth : frame.truths)
    seen.count(truth) != 0 ? void(lost_.erase(truth)) : void(lost_.insert(truth));
  sums_.truths += truths.size();
  sums_.matches += matches.size();
  sums_.misses += truths.size() - matches.size();
  sums_.wrong += frame.tracks.size() - matches.size();
  return matches;
}

// The pairs of a frame that are together as often as possible over the whole sequence, and alike.
std::vector<TrackScore::Pair> TrackScore::align(const std::map<std::pair<Key, Key>, double>& alignment,
                                                const Frame& frame) const {
  std::vector<AssignmentPair> costs;
  for (const Pair& pair : frame.pairs) {
    const auto row = std::find(frame.truths.begin(), frame.truths.end(), pair.truth);
    const auto column = std::find(frame.tracks.begin(), frame.tracks.end(), pair.track);
    costs.push_back({static_cast<std::size_t>(row - frame.truths.begin()),
                     static_cast<std::size_t>(column - frame.tracks.begin()),
                     1 - alignment.at({pair.truth, pair.track}) * pair.similarity});
  }
  std::sort(costs.begin(), costs.end(), [](const AssignmentPair& a, const AssignmentPair& b) {
    return std::pair(a.row, a.column) < std::pair(b.row, b.column);
  });
  SparseAssignment assignment;
  assignment.solve(frame.truths.size(), frame.tracks.size(), costs, 1);
  std::vector<Pair> aligned;
  for (const Pair& pair : frame.pairs) {
    const auto row = std::find(frame.truths.begin(), frame.truths.end(), pair.truth);
    const std::size_t column = assignment.columns()[static_cast<std::size_t>(row - frame.truths.begin())];
    if (column < frame.tracks.size() && frame.tracks[column] == pair.track) aligned.push_back(pair);
  }
  return aligned;
}

TrackScores TrackScore::result() const {
  TrackScores result = sums_;
  if (sums_.truths == 0) return result;
  const auto truths = static_cast<double>(sums_.truths);
  result.mota = 1 - static_cast<double>(sums_.misses + sums_.wrong + sums_.switches) / truths;
  std::map<Key, double> truth_frames, track_frames;
  std::map<std::pair<Key, Key>, double> together, alignment;
  double tracks = 0;
  for (const Frame& frame : frames_) {
    std::map<Key, double> of_truth, of_track;
    for (const Key& key : frame.truths)
      ++truth_frames[key];
    for (const Key& key : frame.tracks)
      ++track_frames[key];
    tracks += static_cast<double>(frame.tracks.size());
    for (const Pair& pair : frame.pairs) {
      of_truth[pair.truth] += pair.similarity;
      of_track[pair.track] += pair.similarity;
    }
    for (const Pair& pair : frame.pairs)
      together[{pair.truth, pair.track}] +=
          pair.similarity / (of_truth[pair.truth] + of_track[pair.track] - pair.similarity);
  }
  for (const auto& [keys, sum] : together)
    alignment[keys] = sum / (truth_frames[keys.first] + track_frames[keys.second] - sum);
  std::vector<Pair> aligned;
  for (const Frame& frame : frames_) {
    const std::vector<Pair> pairs = align(alignment, frame);
    aligned.insert(aligned.end(), pairs.begin(), pairs.end());
  }
  constexpr int kThresholds = 19;
  for (int k = 1; k <= kThresholds; ++k) {
    std::map<std::pair<Key, Key>, double> count;
    double matched = 0, association = 0;
    for (const Pair& pair : aligned) {
      if (pair.similarity < 0.05 * k - 1e-9) continue;
      ++count[{pair.truth, pair.track}];
      ++matched;
    }
    for (const auto& [keys, n] : count)
      association += n * n / (truth_frames[keys.first] + track_frames[keys.second] - n);
    association = matched > 0 ? association / matched : 0;
    const double detection = matched / (truths + tracks - matched);
    result.detection += detection / kThresholds;
    result.association += association / kThresholds;
    result.hota += std::sqrt(detection * association) / kThresholds;
  }
  return result;
}

}  // namespace pcl_bv::bench
