// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_tree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "device_tree.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "tree_questions.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Factors that contain all relative errors of products and roots of floats, on the device and here.
constexpr double kUp = 1 + 0x1p-16, kDown = 1 - 0x1p-16;
// Above the squared distances of all points for which there is a question, and below those of empty boxes.
constexpr double kNoLimit = 0x1p117;

// Questions that a thread answers at a time from the tree in memory.
constexpr std::size_t kBlock = 256;

// Answers of several questions. A question that is left to the processor is marked.
class Marks {
 public:
  explicit Marks(std::size_t count) : marked_(count, 0) {}

  void mark(std::size_t i) { marked_[i] = 1; }

  // Calls answer(i) for the marked questions, in parallel.
  template <typename Answer>
  void for_each(const Execution& execution, const Answer& answer) const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < marked_.size(); ++i)
      if (marked_[i] != 0) numbers.push_back(i);
    for_each_range(execution.parallel, numbers.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n)
        answer(numbers[n]);
    });
  }

 private:
  std::vector<std::uint8_t> marked_;
};

// As Neighbor describes it.
double squared_distance(const Candidate& point, const Coordinates& from) {
  const double x = point.x - from.x, y = point.y - from.y, z = point.z - from.z;
  return x * x + y * y + z * z;
}

std::int32_t index_of(const PointView& points, const TreePart& part, const Candidate& point) {
  return static_cast<std::int32_t>(points.index(part.first + point.number));
}

float square(double distance) {
  return static_cast<float>(std::min(distance * distance, kNoLimit));
}

// Returns the question for the points whose squared distance is at most `limit`.
std::optional<DeviceQuestion> ball_question(const DeviceTree& tree, const Coordinates& center, double limit) {
  std::optional<DeviceQuestion> question = question_at(tree, center, 0);
  if (!question) return question;
  const double radius = std::sqrt(limit), error = question->error;
  question->limit = square((radius * kUp + error) * kUp);
  if (radius > error) question->inside = square((radius * kDown - error) * kDown);
  return question;
}

}  // namespace

GpuTree::GpuTree(const GpuCloud& cloud) {
  const FloatEnvironment environment;
  tree_ = std::make_unique<DeviceTree>(cloud);
}
GpuTree::~GpuTree() = default;
GpuTree::GpuTree(GpuTree&&) noexcept = default;
GpuTree& GpuTree::operator=(GpuTree&&) noexcept = default;

void GpuTree::refit(const GpuCloud& cloud) {
  const FloatEnvironment environment;
  tree_->refit(cloud);
}

std::size_t GpuTree::size() const {
  return tree_->size();
}

std::size_t GpuTree::dropped() const {
  return tree_->dropped();
}

void nearest(const GpuTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance, const Execution& execution) {
  if (query_points.source != nullptr)
    throw std::invalid_argument("GpuTree: the query points must be in memory");
  if (!(max_distance >= 0)) throw std::invalid_argument("GpuTree: a distance must be 0 or more");
  const FloatEnvironment environment;
  const DeviceTree& on_device = tree.on_device();
  const PointView points = on_device.cloud().points();
  const double limit = max_distance * max_distance;
  const Neighbor none{-1, kInfinity};
  found.assign(query_points.count, none);
  Marks marks(found.size());
  ask(
      on_device, QuestionKind::nearest, found.size(), execution,
      [&](std::size_t i) {
        const Coordinates place = load_point(query_points, i);
        if (!is_valid(place)) return DeviceQuestion();
        if (const auto question = ball_question(on_device, place, limit)) return *question;
        marks.mark(i);
        return DeviceQuestion();
      },
      [&](std::size_t i, const TreePart& part, const DeviceAnswer& answer) {
        if (answer.candidates == DeviceAnswer::kMany) return marks.mark(i);
        const Coordinates place = load_point(query_points, i);
        for (std::size_t c = 0; c < answer.candidates; ++c) {
          const Candidate& point = answer.found[c];
          const Neighbor candidate{index_of(points, part, point), squared_distance(point, place)};
          if (candidate.squared_distance <= limit && candidate < found[i]) found[i] = candidate;
        }
      });
  marks.for_each(execution, [&](std::size_t i) {
    const Coordinates place = load_point(query_points, i);
    found[i] = on_device.on_host().nearest({place.x, place.y, place.z}, max_distance).value_or(none);
  });
}

void any_inside(const GpuTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution) {
  const FloatEnvironment environment;
  const DeviceTree& on_device = tree.on_device();
  const auto center_of = [&](std::size_t i) {
    const Eigen::Vector3d center = spheres[i].center();
    return Coordinates{center.x(), center.y(), center.z()};
  };
  inside.assign(spheres.size(), 0);
  Marks marks(spheres.size());
  ask(
      on_device, QuestionKind::any, spheres.size(), execution,
      [&](std::size_t i) {
        if (spheres[i].empty()) return DeviceQuestion();
        if (const auto question = ball_question(on_device, center_of(i), spheres[i].max_squared_distance()))
          return *question;
        marks.mark(i);
        return DeviceQuestion();
      },
      [&](std::size_t i, const TreePart&, const DeviceAnswer& answer) {
        if (answer.candidates == DeviceAnswer::kMany) return marks.mark(i);
        if (answer.candidates == DeviceAnswer::kCertainly) {
          inside[i] = 1;
          return;
        }
        for (std::size_t c = 0; c < answer.candidates; ++c) {
          if (squared_distance(answer.found[c], center_of(i)) <= spheres[i].max_squared_distance())
            inside[i] = 1;
        }
      });
  marks.for_each(execution, [&](std::size_t i) {
    inside[i] = static_cast<std::uint8_t>(on_device.on_host().any_inside(spheres[i]));
  });
}

namespace {

// Returns the question of a moving sphere, or nothing if the device cannot answer it.
std::optional<DeviceQuestion> sweep_question(const DeviceTree& tree, const MovingSphere& sphere) {
  const Eigen::Vector3d& origin = sphere.origin;
  const Eigen::Vector3d direction = sphere.direction / sphere.direction.lpNorm<Eigen::Infinity>();
  const Eigen::Vector3d unit = direction.normalized();
  if (!unit.allFinite() || !(unit.squaredNorm() > 0.9))
    return std::nullopt;  // the direction is zero or denormal
  std::optional<DeviceQuestion> question =
      question_at(tree, {origin.x(), origin.y(), origin.z()}, sphere.radius);
  if (!question) return question;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    question->direction[axis] = static_cast<float>(unit[axis]);
  question->limit = 0x1p60F;
  question->reach = static_cast<float>((sphere.radius * kUp + 2 * question->error) * kUp);
  question->inside = static_cast<float>((sphere.radius * kDown - 2 * question->error) * kDown);
  return question;
}

void check(const MovingSphere& sphere) {
  if (!(sphere.radius >= 0 && sphere.radius <= kMaxCoordinate))
    throw std::invalid_argument("GpuTree: the radius of a moving sphere must be from 0 to 1e100, not " +
                                std::to_string(sphere.radius));
}

}  // namespace

void first_hit(const GpuTree& tree, const std::vector<MovingSphere>& spheres,
               std::vector<std::optional<PointHit>>& found, const Execution& execution) {
  const FloatEnvironment environment;
  std::for_each(spheres.begin(), spheres.end(), check);
  const DeviceTree& on_device = tree.on_device();
  const PointView points = on_device.cloud().points();
  found.assign(spheres.size(), std::nullopt);
  Marks marks(spheres.size());
  ask(
      on_device, QuestionKind::first_hit, spheres.size(), execution,
      [&](std::size_t i) {
        const MovingSphere& sphere = spheres[i];
        if (!sphere.origin.allFinite() || !sphere.direction.allFinite()) return DeviceQuestion();
        if (const auto question = sweep_question(on_device, sphere)) return *question;
        marks.mark(i);
        return DeviceQuestion();
      },
      [&](std::size_t i, const TreePart& part, const DeviceAnswer& answer) {
        if (answer.candidates == DeviceAnswer::kMany) return marks.mark(i);
        for (std::size_t c = 0; c < answer.candidates; ++c) {
          const Candidate& point = answer.found[c];
          const auto touched = Sphere({point.x, point.y, point.z}, spheres[i].radius)
                                   .intersect(spheres[i].origin, spheres[i].direction);
          if (!touched) continue;
          const PointHit hit{index_of(points, part, point), touched->enter};
          const bool first =
              !found[i] || hit.t < found[i]->t || (hit.t == found[i]->t && hit.index < found[i]->index);
          if (first) found[i] = hit;
        }
      });
  marks.for_each(execution, [&](std::size_t i) {
    const MovingSphere& sphere = spheres[i];
    found[i] = on_device.on_host().first_hit(sphere.origin, sphere.direction, sphere.radius);
  });
}

}  // namespace pcl_bv
