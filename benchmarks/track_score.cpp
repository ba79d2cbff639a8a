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
  std::vector<Pair> matched_pairs;
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
      matched_pairs.push_back(pairs.back());
      matched = true;
    }
    if (found[f].other && !matched) continue;
    frame.tracks.push_back(track);
    frame.pairs.insert(frame.pairs.end(), pairs.begin(), pairs.end());
  }
  std::sort(matches.begin(), matches.end());
  count(frame, matched_pairs);
  return matches;
}

std::vector<std::pair<std::size_t, std::size_t>> TrackScore::add(const std::vector<std::uint32_t>& truths,
                                                                 const std::vector<std::uint32_t>& tracks,
                                                                 std::vector<SimilarPair> pairs,
                                                                 double min_similarity) {
  Frame& frame = frames_.emplace_back();
  for (const std::uint32_t id : truths)
    frame.truths.emplace_back(sequence_, id);
  for (const std::uint32_t id : tracks)
    frame.tracks.emplace_back(sequence_, id);
  std::sort(pairs.begin(), pairs.end(), [](const SimilarPair& a, const SimilarPair& b) {
    return std::pair(a.truth, a.track) < std::pair(b.truth, b.track);
  });
  // An assignment of minimum cost is one of maximum weight if not to be assigned costs more than any weight.
  constexpr double kStays = 1000, kUnassigned = 2 * kStays;
  std::vector<AssignmentPair> costs;
  for (const auto& [t, f, similarity] : pairs) {
    const Key& truth = frame.truths[t];
    frame.pairs.push_back({truth, frame.tracks[f], similarity});
    if (similarity < min_similarity) continue;
    const auto before = previous_.find(truth);
    const bool stays = before != previous_.end() && before->second == tracks[f];
    costs.push_back({t, f, kUnassigned - similarity - (stays ? kStays : 0)});
  }
  SparseAssignment assignment;
  assignment.solve(truths.size(), tracks.size(), costs, kUnassigned);
  std::vector<std::pair<std::size_t, std::size_t>> matches;
  std::vector<Pair> matched_pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (assignment.columns()[pairs[i].truth] != pairs[i].track) continue;
    matches.emplace_back(pairs[i].truth, pairs[i].track);
    matched_pairs.push_back(frame.pairs[i]);
  }
  count(frame, matched_pairs);
  return matches;
}

void TrackScore::count(const Frame& frame, const std::vector<Pair>& matches) {
  std::set<Key> seen;
  previous_.clear();
  for (const auto& [truth, track, similarity] : matches) {
    const auto [last, first] = last_.try_emplace(truth, track.second);
    sums_.switches += last->second != track.second;
    sums_.fragments += !first && lost_.count(truth) != 0;
    last->second = previous_[truth] = track.second;
    similarity_ += similarity;
    seen.insert(truth);
  }
  for (const Key& truth : frame.truths)
    seen.count(truth) != 0 ? void(lost_.erase(truth)) : void(lost_.insert(truth));
  sums_.truths += frame.truths.size();
  sums_.matches += matches.size();
  sums_.misses += frame.truths.size() - matches.size();
  sums_.wrong += frame.tracks.size() - matches.size();
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
  if (sums_.matches > 0) result.motp = similarity_ / static_cast<double>(sums_.matches);
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
