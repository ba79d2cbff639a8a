// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree_questions.h"

#include <algorithm>
#include <cstring>

#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

// Questions of one dispatch. Their answers take 10 MiB.
constexpr std::size_t kMostAtOnce = 131'072;
// Questions that a thread prepares or decides at a time.
constexpr std::size_t kBlock = 1024;

// What the shader declares.
struct TreePush {
  float center[3];
  std::uint32_t count, levels, first[TreePart::kMostLevels];
};

// Asks slices of the questions with the same buffers.
class Questions {
 public:
  Questions(const DeviceTree& tree, QuestionKind kind, std::size_t most)
      : tree_(tree),
        context_(tree.cloud().on_device().context()),
        pipeline_(context_->pipeline(Shader::questions, {static_cast<std::uint32_t>(kind)})),
        input_(*context_, sizeof(DeviceQuestion) * most, BufferUse::upload),
        questions_(*context_, sizeof(DeviceQuestion) * most, BufferUse::device),
        answers_(*context_, sizeof(DeviceAnswer) * most, BufferUse::device),
        output_(*context_, sizeof(DeviceAnswer) * most, BufferUse::download) {}

  void set(std::size_t i, const DeviceQuestion& question) {
    std::memcpy(input_.mapped() + i * sizeof question, &question, sizeof question);
  }

  void ask(const TreePart& part, std::size_t count) {
    Submission submission(context_);
    submission.copy(input_, 0, questions_, 0, sizeof(DeviceQuestion) * count);
    TreePush push{{tree_.center()[0], tree_.center()[1], tree_.center()[2]},
                  static_cast<std::uint32_t>(count),
                  part.levels,
                  {}};
    std::copy_n(part.first_group.begin(), TreePart::kMostLevels, push.first);
    submission.dispatch(pipeline_,
                        {{part.packets.get()},
                         {part.numbers.get()},
                         {part.boxes.get()},
                         {questions_.get()},
                         {answers_.get()}},
                        push, static_cast<std::uint32_t>((count + kWorkgroup - 1) / kWorkgroup));
    submission.copy(answers_, 0, output_, 0, sizeof(DeviceAnswer) * count);
    submission.run();
  }

  DeviceAnswer answer(std::size_t i) const {
    DeviceAnswer answer;
    std::memcpy(&answer, output_.mapped() + i * sizeof answer, sizeof answer);
    return answer;
  }

 private:
  const DeviceTree& tree_;
  std::shared_ptr<GpuContext> context_;
  const ComputePipeline& pipeline_;
  ScratchBuffer input_, questions_, answers_, output_;
};

}  // namespace

std::optional<DeviceQuestion> question_at(const DeviceTree& tree, const Coordinates& place, double reach) {
  DeviceQuestion question;
  double farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double relative = place[axis] - tree.center()[axis];
    farthest = std::max(farthest, std::abs(relative));
    question.place[axis] = static_cast<float>(relative);
  }
  const double sum = tree.extent() + farthest + reach;
  if (!(sum <= kLargestOnDevice)) return std::nullopt;
  question.error = static_cast<float>(sum * 0x1p-18 + 0x1p-58);
  return question;
}

void ask(const DeviceTree& tree, QuestionKind kind, std::size_t count, const Execution& execution,
         const std::function<DeviceQuestion(std::size_t)>& make,
         const std::function<void(std::size_t, const TreePart&, const DeviceAnswer&)>& take) {
  if (tree.parts().empty() || count == 0) return;
  const std::size_t in_binding = tree.cloud().on_device().context()->max_binding() / sizeof(DeviceAnswer);
  const std::size_t most = std::min({count, kMostAtOnce, in_binding});
  Questions questions(tree, kind, most);
  for (std::size_t first = 0; first < count; first += most) {
    const std::size_t taken = std::min(most, count - first);
    for_each_range(execution.parallel, taken, kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        questions.set(i, make(first + i));
    });
    for (const TreePart& part : tree.parts()) {
      questions.ask(part, taken);
      for_each_range(execution.parallel, taken, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          take(first + i, part, questions.answer(i));
      });
    }
  }
}

}  // namespace pcl_bv::detail
