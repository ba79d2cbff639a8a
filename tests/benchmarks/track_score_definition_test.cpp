// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scores of random sequences next to their definitions, computed here over all assignments.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "track_score.h"

namespace pcl_bv::bench {
namespace {

constexpr std::size_t kFrames = 7, kObjects = 3;

// Similarities by frame, object and track; 0 where one of them is not in the frame.
struct Sequence {
  std::array<std::array<std::array<double, kObjects>, kObjects>, kFrames> similarity{};
  std::array<std::array<bool, kObjects>, kFrames> truth{}, track{};
};

Sequence random_sequence(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Sequence made;
  for (std::size_t f = 0; f < kFrames; ++f) {
    for (std::size_t i = 0; i < kObjects; ++i) {
      made.truth[f][i] = uniform(random) < 0.85;
      made.track[f][i] = uniform(random) < 0.85;
    }
    for (std::size_t t = 0; t < kObjects; ++t)
      for (std::size_t k = 0; k < kObjects; ++k)
        if (made.truth[f][t] && made.track[f][k] && uniform(random) < 0.7)
          made.similarity[f][t][k] = t == k ? 0.3 + 0.7 * uniform(random) : uniform(random);
  }
  return made;
}

using Assignment = std::array<int, kObjects>;  // the track of each object, or -1

// Returns the assignment of maximum sum; pairs of weight 0 are not assigned.
Assignment best_assignment(const std::function<double(std::size_t, std::size_t)>& weight) {
  Assignment best{-1, -1, -1}, now{};
  double most = 0;
  for (now[0] = -1; now[0] < 3; ++now[0])
    for (now[1] = -1; now[1] < 3; ++now[1])
      for (now[2] = -1; now[2] < 3; ++now[2]) {
        double sum = 0;
        bool allowed = true;
        for (std::size_t t = 0; t < kObjects; ++t) {
          if (now[t] < 0) continue;
          for (std::size_t u = 0; u < t; ++u)
            allowed = allowed && now[u] != now[t];
          const double w = weight(t, static_cast<std::size_t>(now[t]));
          allowed = allowed && w > 0;
          sum += w;
        }
        if (!allowed || sum <= most) continue;
        most = sum;
        best = now;
      }
  return best;
}

struct Clear {
  double mota = 0, motp = 0;
  std::size_t switches = 0, fragments = 0;
};

Clear clear_of(const Sequence& s, double min_similarity) {
  std::map<std::size_t, int> last;
  std::set<std::size_t> lost;
  Assignment before{-1, -1, -1};
  double truths = 0, tracks = 0, matches = 0, similarity = 0;
  Clear clear;
  for (std::size_t f = 0; f < kFrames; ++f) {
    const Assignment now = best_assignment([&](std::size_t t, std::size_t k) {
      const double w = s.similarity[f][t][k];
      return w < min_similarity ? 0 : w + (before[t] == static_cast<int>(k) ? 1000 : 0);
    });
    for (std::size_t t = 0; t < kObjects; ++t) {
      truths += s.truth[f][t];
      tracks += s.track[f][t];
      if (now[t] < 0) {
        if (s.truth[f][t]) lost.insert(t);
        continue;
      }
      ++matches;
      similarity += s.similarity[f][t][static_cast<std::size_t>(now[t])];
      clear.switches += last.count(t) != 0 && last[t] != now[t];
      clear.fragments += last.count(t) != 0 && lost.count(t) != 0;
      last[t] = now[t];
      lost.erase(t);
    }
    before = now;
  }
  clear.mota = 1 - (truths - matches + tracks - matches + static_cast<double>(clear.switches)) / truths;
  clear.motp = similarity / matches;
  return clear;
}

// HOTA as Luiten et al. 2021 define it: the matches are those of maximum similarity, weighted by how well
// object and track are aligned over the whole sequence; then the mean over thresholds of sqrt(DetA * AssA).
double hota_of(const Sequence& s) {
  std::array<std::array<double, kObjects>, kObjects> shared{};
  std::array<double, kObjects> of_truth{}, of_track{};
  double truths = 0, tracks = 0;
  for (std::size_t f = 0; f < kFrames; ++f) {
    for (std::size_t i = 0; i < kObjects; ++i) {
      of_truth[i] += s.truth[f][i];
      of_track[i] += s.track[f][i];
      truths += s.truth[f][i];
      tracks += s.track[f][i];
    }
    for (std::size_t t = 0; t < kObjects; ++t)
      for (std::size_t k = 0; k < kObjects; ++k) {
        double all = -s.similarity[f][t][k];
        for (std::size_t i = 0; i < kObjects; ++i)
          all += s.similarity[f][t][i] + s.similarity[f][i][k];
        if (all > 0) shared[t][k] += s.similarity[f][t][k] / all;
      }
  }
  std::vector<Assignment> matches;
  for (std::size_t f = 0; f < kFrames; ++f)
    matches.push_back(best_assignment([&](std::size_t t, std::size_t k) {
      const double alignment = shared[t][k] / (of_truth[t] + of_track[k] - shared[t][k]);
      return alignment * s.similarity[f][t][k];
    }));
  double hota = 0;
  for (int threshold = 1; threshold <= 19; ++threshold) {
    std::array<std::array<double, kObjects>, kObjects> count{};
    double matched = 0, association = 0;
    for (std::size_t f = 0; f < kFrames; ++f)
      for (std::size_t t = 0; t < kObjects; ++t) {
        const int k = matches[f][t];
        if (k < 0 || s.similarity[f][t][static_cast<std::size_t>(k)] < threshold / 20.0) continue;
        ++count[t][static_cast<std::size_t>(k)];
        ++matched;
      }
    for (std::size_t t = 0; t < kObjects; ++t)
      for (std::size_t k = 0; k < kObjects; ++k)
        association += count[t][k] * count[t][k] / std::max(1.0, of_truth[t] + of_track[k] - count[t][k]);
    if (matched > 0) hota += std::sqrt(matched / (truths + tracks - matched) * association / matched) / 19;
  }
  return hota;
}

TEST(TrackScore, OfBoxesFollowsTheDefinitionsOfMotaAndHota) {
  std::mt19937 random(2021);
  std::size_t switches = 0, fragments = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const Sequence s = random_sequence(random);
    TrackScore score;
    for (std::size_t f = 0; f < kFrames; ++f) {
      std::vector<std::uint32_t> truths, tracks;
      std::array<std::size_t, kObjects> column{};
      for (std::size_t k = 0; k < kObjects; ++k) {
        column[k] = tracks.size();
        if (s.track[f][k]) tracks.push_back(static_cast<std::uint32_t>(10 + k));
      }
      std::vector<SimilarPair> pairs;
      for (std::size_t t = 0; t < kObjects; ++t) {
        if (!s.truth[f][t]) continue;
        for (std::size_t k = 0; k < kObjects; ++k)
          if (s.similarity[f][t][k] > 0) pairs.push_back({truths.size(), column[k], s.similarity[f][t][k]});
        truths.push_back(static_cast<std::uint32_t>(t));
      }
      std::shuffle(pairs.begin(), pairs.end(), random);  // the order of pairs must not matter
      score.add(truths, tracks, pairs, 0.4);
    }
    const TrackScores found = score.result();
    const Clear clear = clear_of(s, 0.4);
    EXPECT_NEAR(found.mota, clear.mota, 1e-12);
    EXPECT_NEAR(found.motp, clear.motp, 1e-12);
    EXPECT_EQ(found.switches, clear.switches);
    EXPECT_EQ(found.fragments, clear.fragments);
    EXPECT_NEAR(found.hota, hota_of(s), 1e-12);
    switches += clear.switches;
    fragments += clear.fragments;
  }
  EXPECT_GT(switches, 100U);
  EXPECT_GT(fragments, 100U);
}

TEST(TrackScore, APairOfTheFrameBeforeIsKeptWhileItIsSimilarEnough) {
  TrackScore score;
  score.add({1}, {7, 8}, {{0, 0, 0.9}, {0, 1, 0.5}}, 0.4);
  EXPECT_EQ(score.add({1}, {7, 8}, {{0, 0, 0.5}, {0, 1, 0.9}}, 0.4).at(0).second, 0U);
  EXPECT_EQ(score.add({1}, {7, 8}, {{0, 0, 0.3}, {0, 1, 0.9}}, 0.4).at(0).second, 1U);
  EXPECT_EQ(score.result().switches, 1U);
  EXPECT_EQ(score.result().wrong, 3U);
}

}  // namespace
}  // namespace pcl_bv::bench
