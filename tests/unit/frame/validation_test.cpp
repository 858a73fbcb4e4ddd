// The frame under the validation layer, and the frame with what must not change its pictures switched off.
#include <algorithm>

#include "lab.h"

namespace rg::test {
namespace {

struct Size {
  uint32_t width, height;
};

FrameData prepare(const Size& size, uint32_t number) {
  FrameSettings settings;
  settings.width = size.width, settings.height = size.height, settings.number = number;
  return demo::make_frame(plaza(), plaza().cameras.at(number % plaza().cameras.size()), settings);
}

// Ten frames at four sizes; each camera in turn.
std::vector<demo::Picture> render_and_resize(Device& device, const demo::RendererOptions& given) {
  const Size sizes[] = {{160, 90}, {97, 61}, {224, 120}, {64, 33}};
  demo::RendererOptions options = given;
  options.width = sizes[0].width, options.height = sizes[0].height;
  auto renderer = demo::Renderer::create(device, plaza(), options);
  EXPECT_TRUE(renderer) << renderer.error().message;
  std::vector<demo::Picture> pictures;
  for (uint32_t number = 0; renderer && number < 10; ++number) {
    const Size& size = sizes[number / 3];
    if (number > 0 && number % 3 == 0) {
      const Status resized = renderer->resize(size.width, size.height);
      EXPECT_TRUE(resized) << resized.error().message;
    }
    const Status rendered = renderer->render(prepare(size, number));
    EXPECT_TRUE(rendered) << rendered.error().message;
    if (!rendered) break;
    auto picture = renderer->picture();
    EXPECT_TRUE(picture) << picture.error().message;
    if (picture) pictures.push_back(std::move(*picture));
  }
  return pictures;
}

// Share of pixels that differ by more than two steps in some channel.
double share_different(const demo::Picture& a, const demo::Picture& b) {
  if (a.texels.size() != b.texels.size()) return 1;
  size_t different = 0;
  for (size_t i = 0; i < a.texels.size(); i += 4)
    different +=
        std::abs(a.texels[i] - b.texels[i]) > 2 || std::abs(a.texels[i + 1] - b.texels[i + 1]) > 2 || std::abs(a.texels[i + 2] - b.texels[i + 2]) > 2;
  return static_cast<double>(different) / static_cast<double>(a.texels.size() / 4);
}

const std::vector<demo::Picture>& plain() {
  static const std::vector<demo::Picture> pictures = render_and_resize(device(), {});
  return pictures;
}

void expect_same(const std::vector<demo::Picture>& pictures) {
  ASSERT_EQ(pictures.size(), plain().size());
  for (size_t i = 0; i < pictures.size(); ++i) EXPECT_TRUE(pictures[i].texels == plain()[i].texels) << "frame " << i;
}

TEST(Validation, TenFramesAndThreeResizesAreSilent) {
  std::string messages;
  DeviceOptions options;
  options.validate = true;
  options.on_message = [&](bool, std::string_view message) { messages += std::string(message) + "\n"; };
  auto validated = Device::create(options);
  ASSERT_TRUE(validated) << validated.error().message;
  ASSERT_TRUE(validated->validating());
  const std::vector<demo::Picture> pictures = render_and_resize(*validated, {});
  EXPECT_EQ(messages, "");
  EXPECT_EQ(validated->validation_messages(), 0u);
  ASSERT_EQ(pictures.size(), 10u);
  for (size_t i = 0; i < pictures.size(); ++i) EXPECT_LE(share_different(pictures[i], plain()[i]), 0.001) << "frame " << i;
}

// Between submits the layer sees less than within one.
TEST(Validation, FramesOfASubmitForEachPassAreSilent) {
  std::string messages;
  DeviceOptions options;
  options.validate = true;
  options.on_message = [&](bool, std::string_view message) { messages += std::string(message) + "\n"; };
  auto validated = Device::create(options);
  ASSERT_TRUE(validated) << validated.error().message;
  auto renderer = demo::Renderer::create(*validated, plaza(), {.width = 64, .height = 36, .submit_per_pass = true});
  ASSERT_TRUE(renderer) << renderer.error().message;
  for (uint32_t number = 0; number < 3; ++number) {
    const Status rendered = renderer->render(prepare({64, 36}, number));
    ASSERT_TRUE(rendered) << rendered.error().message;
  }
  EXPECT_EQ(messages, "");
}

TEST(Pictures, AreTheSameWithoutAliasing) { expect_same(render_and_resize(device(), {.aliasing = false})); }
TEST(Pictures, AreTheSameOneFrameAtATime) { expect_same(render_and_resize(device(), {.frames_in_flight = 1})); }
TEST(Pictures, AreTheSameOnPoisonedMemory) { expect_same(render_and_resize(device(), {.poison = true})); }
TEST(Pictures, AreTheSameWithASubmitForEachPass) { expect_same(render_and_resize(device(), {.submit_per_pass = true})); }

}  // namespace
}  // namespace rg::test
