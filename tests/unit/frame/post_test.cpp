// Exposure, temporal resolve, bloom and tone mapping: analytic cases, fixed points, and a double-precision reference.
#include <cmath>

#include "tests/reference/shading.h"
#include "tests/unit/frame/lab.h"

namespace rg::test {
namespace {

namespace pass = frame::pass;
namespace resource = frame::resource;

struct Exposure {
  float scale, log_luminance, target, valid;
};

// A glow whose luminance is the middle of a histogram bin: bins are 16/127 of log2 apart from -10 on.
float grey_of_bin(int bin) { return std::exp2(-10.0f + 16.0f * static_cast<float>(bin) / 127.0f); }

glm::dvec3 rgb(const glm::vec4& v) { return glm::dvec3(v); }

// A filtered read may take 1/256 too much of a neighbour in each axis, several reads add up, and a half rounds: relative to the
// brightest texel around.
double filter_error(const Texels& image, int x, int y, int reach) {
  float brightest = 0;
  for (int v = std::max(y - reach, 0); v <= std::min(y + reach, image.height - 1); ++v)
    for (int u = std::max(x - reach, 0); u <= std::min(x + reach, image.width - 1); ++u)
      brightest = std::max({brightest, image.at(u, v).r, image.at(u, v).g, image.at(u, v).b});
  return brightest / 50 + 1e-5;
}

TEST(Exposure, PutsAConstantPictureOnMiddleGrey) {
  for (const int bin : {40, 79, 100}) {
    const Scene room = make_room(glm::vec3(grey_of_bin(bin)));
    Lab lab(room, 64, 48);
    const auto exposure = lab.buffer<Exposure>(lab.prepare(), pass::expose, resource::exposure);
    ASSERT_GE(exposure.size(), 1u);
    EXPECT_NEAR(exposure[0].log_luminance, std::log2(grey_of_bin(bin)), 1e-4);
    EXPECT_NEAR(exposure[0].scale, 0.18 / grey_of_bin(bin), 1e-3 * 0.18 / grey_of_bin(bin));
    EXPECT_EQ(exposure[0].valid, 1.0f);
  }
}

TEST(Exposure, FollowsWithAFixedShareEachFrame) {
  const Scene dark = make_room(glm::vec3(grey_of_bin(60)));
  Lab lab(dark, 64, 48);
  FrameData data = lab.prepare();
  lab.render(data);
  // The same room, brighter: what a wall emits is not in FrameData, so that the sky takes its place.
  data.instances.clear();
  data.view.instance_count = 0;
  data.view.ambient = {0.5f, 0.5f, 0.5f};
  const auto first = lab.buffer<Exposure>(data, pass::expose, resource::exposure)[0];
  const double before = std::log2(grey_of_bin(60));
  EXPECT_GT(first.target, before + 1);
  EXPECT_NEAR(first.log_luminance, before + 0.08 * (first.target - before), 2e-3);
  const auto second = lab.buffer<Exposure>(data, pass::expose, resource::exposure)[0];
  EXPECT_NEAR(second.log_luminance, first.log_luminance + 0.08 * (second.target - first.log_luminance), 1e-3);
}

TEST(Resolve, KeepsAConstant) {
  const Scene room = make_room({0.5f, 0.25f, 0.125f});
  Lab lab(room, 64, 48);
  for (uint32_t number = 0; number < 10; ++number) lab.render(lab.prepare(0, {.number = number}));
  const Texels color = lab.image(lab.prepare(0, {.number = 10}), pass::resolve_temporal, resource::color);
  for (const glm::vec4& texel : color.data) {
    ASSERT_NEAR(texel.r, 0.5f, 2e-3f);
    ASSERT_NEAR(texel.g, 0.25f, 1e-3f);
    ASSERT_NEAR(texel.b, 0.125f, 1e-3f);
    ASSERT_EQ(texel.a, 1.0f);
  }
}

TEST(Resolve, OfAStillPictureIsThePicture) {
  Lab lab(plaza());
  const FrameData data = lab.prepare();
  for (int i = 0; i < 3; ++i) lab.render(data);
  const Texels hdr = lab.image(data, pass::hologram, resource::hdr), color = lab.image(data, pass::resolve_temporal, resource::color);
  for (int y = 0; y < hdr.height; ++y)
    for (int x = 0; x < hdr.width; ++x)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(color.at(x, y)[c], hdr.at(x, y)[c], filter_error(hdr, x, y, 1)) << "texel " << x << " " << y;
}

double mean_difference(const Texels& a, const Texels& b) {
  double sum = 0;
  for (size_t i = 0; i < a.data.size(); ++i) sum += glm::length(rgb(a.data[i]) - rgb(b.data[i])) / (1 + glm::length(rgb(a.data[i])));
  return sum / static_cast<double>(a.data.size());
}

// Eight places of jitter repeat; under them a still scene settles.
TEST(Resolve, ConvergesUnderJitter) {
  Lab lab(plaza(), 96, 54);
  const auto color_of = [&](uint32_t number) {
    return lab.image(lab.prepare(0, {.number = number, .noise = false, .animate = false}), pass::resolve_temporal, resource::color);
  };
  std::vector<Texels> at;
  for (uint32_t number = 0; number <= 24; ++number)
    if (Texels texels = color_of(number); number % 8 == 0) at.push_back(std::move(texels));
  const double early = mean_difference(at[0], at[1]), late = mean_difference(at[2], at[3]);
  EXPECT_LT(late, 0.5 * early);
  EXPECT_LT(late, 4e-3);
}

TEST(Bloom, KeepsAConstantAtEveryLevel) {
  const Scene room = make_room(glm::vec3(0.5f));
  Lab lab(room, 128, 96);
  const FrameData data = lab.prepare();
  std::vector<DumpOf> what;
  for (uint32_t mip = 0; mip < 6; ++mip)
    for (const Index after : {pass::bloom_down_5, pass::bloom_up_5}) what.push_back({after, resource::bloom, mip});
  const std::vector<Dump> all = lab.dumps(data, what);
  for (uint32_t mip = 0; mip < 6; ++mip) {
    const Texels down = texels_of(all[2 * mip]), up = texels_of(all[2 * mip + 1]);
    for (const glm::vec4& texel : down.data) ASSERT_NEAR(texel.g, 0.5f, 2e-3f) << "down, mip " << mip;
    for (const glm::vec4& texel : up.data) ASSERT_NEAR(texel.g, 0.5f, 2e-3f) << "up, mip " << mip;
  }
}

// Bilinear with clamped edges, at (u, v) in texels.
glm::dvec3 sample(const Texels& image, double u, double v) {
  const double x = u - 0.5, y = v - 0.5, fx = x - std::floor(x), fy = y - std::floor(y);
  const auto texel = [&](int i, int j) { return rgb(image.at(std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1))); };
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), fx), glm::mix(texel(i, j + 1), texel(i + 1, j + 1), fx), fy);
}

TEST(Bloom, DownIsTheMeanOfFourTaps) {
  Lab lab(plaza());
  const FrameData data = lab.prepare();
  lab.render(data);
  const std::vector<Dump> all = lab.dumps(data, {{pass::bloom_first, resource::bloom}, {pass::bloom_down_1, resource::bloom, 1}});
  const Texels source = texels_of(all[0]), target = texels_of(all[1]);
  ASSERT_EQ(source.width, 106);
  ASSERT_EQ(target.width, 53);
  for (int y = 0; y < target.height; ++y)
    for (int x = 0; x < target.width; ++x) {
      const double u = (x + 0.5) * source.width / target.width, v = (y + 0.5) * source.height / target.height;
      const glm::dvec3 expected =
          0.25 * (sample(source, u - 1, v - 1) + sample(source, u + 1, v - 1) + sample(source, u - 1, v + 1) + sample(source, u + 1, v + 1));
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(target.at(x, y)[c], expected[c], filter_error(source, 2 * x, 2 * y, 3)) << x << " " << y;
    }
}

TEST(Bloom, NeitherAddsNorLosesLight) {
  Lab lab(plaza(), 256, 128);
  const FrameData data = lab.prepare();
  const auto mean = [](const Texels& image) {
    glm::dvec3 sum(0);
    for (const glm::vec4& texel : image.data) sum += rgb(texel);
    return sum / static_cast<double>(image.data.size());
  };
  const std::vector<Dump> all = lab.dumps(data, {{pass::bloom_first, resource::bloom}, {pass::bloom_up_5, resource::bloom}});
  const glm::dvec3 first = mean(texels_of(all[0])), whole = mean(texels_of(all[1]));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(whole[c], first[c], 0.05 * first[c]) << "channel " << c;
}

TEST(ToneMap, IsTheReference) {
  Lab lab(plaza(), 106, 58);
  const FrameData data = lab.prepare();
  for (int i = 0; i < 3; ++i) lab.render(data);  // a still picture from here on, but for its exposure
  const Texels bloom = lab.image(data, pass::bloom_up_5, resource::bloom, 0);
  const float scale = lab.buffer<Exposure>(data, pass::expose, resource::exposure)[0].scale;
  const Texels color = lab.image(data, pass::resolve_temporal, resource::color);  // of the frame that made the picture
  const demo::Picture picture = lab.picture();
  uint32_t far_off = 0;
  for (int y = 0; y < color.height; ++y)
    for (int x = 0; x < color.width; ++x) {
      const glm::dvec3 glow = sample(bloom, (x + 0.5) * bloom.width / color.width, (y + 0.5) * bloom.height / color.height);
      const glm::dvec3 expected = 255.0 * reference::tone_map(glm::mix(rgb(color.at(x, y)), glow, 0.09) * static_cast<double>(scale));
      for (int c = 0; c < 3; ++c)
        far_off += std::abs(picture.texels[static_cast<size_t>(y * color.width + x) * 4 + static_cast<size_t>(c)] - expected[c]) > 2.0;
    }
  EXPECT_EQ(far_off, 0u);
}

}  // namespace
}  // namespace rg::test
