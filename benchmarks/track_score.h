// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How well objects keep their ids, where the truth is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pcl_bv::bench {

/// An object with enough returns to be asked for.
struct TrueObject {
  std::uint32_t id = 0;
  std::size_t points = 0;
};

/// What a track has in a frame.
struct FoundObject {
  std::uint32_t track = 0;
  std::size_t points = 0;
  std::vector<std::pair<std::size_t, std::size_t>> shared;  ///< True object (its place in the list), points.
  /// Most of its points are of things that are not asked for: not counted, unless it matches a true object.
  bool other = false;
};

/// A true object and a track that overlap, by their indices in the lists of a frame. `similarity` is above 0
/// and at most 1.
struct SimilarPair {
  std::size_t truth = 0, track = 0;
  double similarity = 0;
};

struct TrackScores {
  std::size_t truths = 0, matches = 0, misses = 0, wrong = 0;
  std::size_t switches = 0;   ///< An object has another track than when it was last matched.
  std::size_t fragments = 0;  ///< An object is matched again after a frame without.
  double mota = 0;            ///< 1 - (misses + wrong + switches) / truths (Bernardin and Stiefelhagen 2008).
  double motp = 0;            ///< Mean similarity of the matches; 0 without matches.
  double hota = 0, detection = 0, association = 0;  ///< Means over 19 thresholds (Luiten et al. 2021).
};

class TrackScore {
 public:
  /// Another sequence: its objects and tracks have nothing to do with those before.
  void start_sequence() { ++sequence_; }

  /// The matches of the frame: true object and found one, by their places in the lists. Similarity is what
  /// two sets of points share of their union (as for MOTS, Voigtlaender et al. 2019): an object and a track
  /// match where it is above one half, and so never two tracks the same object.
  std::vector<std::pair<std::size_t, std::size_t>> add(const std::vector<TrueObject>& truths,
                                                       const std::vector<FoundObject>& found);

  /// Adds a frame whose similarities are known, such as the IoU of boxes. `truths` and `tracks` are ids.
  /// `pairs` holds each pair once; pairs that are missing have a similarity of 0. Returns the matches by
  /// their indices: one to one and of at least `min_similarity`. Pairs that matched in the frame before are
  /// kept (Bernardin and Stiefelhagen 2008); of the other pairs, the sum of similarities is maximal.
  std::vector<std::pair<std::size_t, std::size_t>> add(const std::vector<std::uint32_t>& truths,
                                                       const std::vector<std::uint32_t>& tracks,
                                                       std::vector<SimilarPair> pairs, double min_similarity);

  /// O(pairs * 19).
  TrackScores result() const;

 private:
  using Key = std::pair<std::size_t, std::uint32_t>;  // sequence, object or track
  struct Pair {
    Key truth, track;
    double similarity = 0;
  };
  struct Frame {
    std::vector<Key> truths, tracks;
    std::vector<Pair> pairs;  // by their places in the lists, ascending
  };

  void count(const Frame& frame, const std::vector<Pair>& matches);
  std::vector<Pair> align(const std::map<std::pair<Key, Key>, double>& alignment, const Frame& frame) const;

  std::size_t sequence_ = 0;
  std::vector<Frame> frames_;
  std::map<Key, std::uint32_t> last_;      // track of the last match
  std::map<Key, std::uint32_t> previous_;  // tracks of the matches of the frame before
  std::set<Key> lost_;
  TrackScores sums_;
  double similarity_ = 0;  // sum over the matches
};

}  // namespace pcl_bv::bench
