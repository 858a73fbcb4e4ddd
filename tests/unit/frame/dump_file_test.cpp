// Dumps as pictures: every format that a resource may have comes out as the numbers that shaders see, and files hold them.
#include "examples/demo/dump_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

namespace rg::demo {
namespace {

namespace fs = std::filesystem;

Dump texel_of(VkFormat format, std::initializer_list<int> bytes) {
  Dump dump;
  dump.format = static_cast<Format>(format);
  dump.width = dump.height = dump.depth_or_layers = 1;
  dump.bytes_per_texel = static_cast<uint32_t>(bytes.size());
  for (const int byte : bytes) dump.bytes.push_back(static_cast<std::byte>(byte));
  return dump;
}

void expect(VkFormat format, std::initializer_list<int> bytes, std::array<float, 4> values) {
  const auto picture = decode_dump(texel_of(format, bytes));
  ASSERT_TRUE(picture) << format << ": " << picture.error().message;
  ASSERT_EQ(picture->texels.size(), 4u);
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(picture->texels[i], values[i], 1e-6f * (1 + std::abs(values[i]))) << format << " channel " << i;
}

TEST(DumpFile, DecodesEightBitsAChannel) {
  expect(VK_FORMAT_R8_UNORM, {51}, {0.2f, 0, 0, 1});
  expect(VK_FORMAT_R8_UINT, {51}, {51, 0, 0, 1});
  expect(VK_FORMAT_R8G8_SNORM, {0x81, 127}, {-1, 1, 0, 1});
  expect(VK_FORMAT_R8G8_SINT, {0x80, 3}, {-128, 3, 0, 1});
  expect(VK_FORMAT_R8G8B8A8_UNORM, {255, 0, 51, 102}, {1, 0, 0.2f, 0.4f});
  expect(VK_FORMAT_B8G8R8A8_UNORM, {255, 0, 51, 102}, {0.2f, 0, 1, 0.4f});
  expect(VK_FORMAT_R8_SRGB, {128}, {0.2158605f, 0, 0, 1});
  expect(VK_FORMAT_R8_SRGB, {5}, {5 / 255.0f / 12.92f, 0, 0, 1});
}

// Alpha of an sRGB format is linear.
TEST(DumpFile, LeavesAlphaOfSrgbAsItIs) {
  expect(VK_FORMAT_R8G8B8A8_SRGB, {128, 255, 0, 128}, {0.2158605f, 1, 0, 128 / 255.0f});
  expect(VK_FORMAT_B8G8R8A8_SRGB, {0, 255, 128, 128}, {0.2158605f, 1, 0, 128 / 255.0f});
}

TEST(DumpFile, DecodesSixteenAndThirtyTwoBitsAChannel) {
  expect(VK_FORMAT_R16_UNORM, {0xff, 0xff}, {1, 0, 0, 1});
  expect(VK_FORMAT_R16_UINT, {0x01, 0x02}, {513, 0, 0, 1});
  expect(VK_FORMAT_R16_SFLOAT, {0x00, 0xc0}, {-2, 0, 0, 1});
  expect(VK_FORMAT_R16G16_SNORM, {0x01, 0x80, 0xff, 0x7f}, {-1, 1, 0, 1});
  expect(VK_FORMAT_R16G16B16A16_SFLOAT, {0x00, 0x3c, 0x00, 0x38, 0x00, 0x00, 0x00, 0x40}, {1, 0.5f, 0, 2});
  expect(VK_FORMAT_R32_UINT, {2, 0, 0, 1}, {16777218, 0, 0, 1});
  expect(VK_FORMAT_R32_SINT, {0xfe, 0xff, 0xff, 0xff}, {-2, 0, 0, 1});
  expect(VK_FORMAT_R32_SFLOAT, {0, 0, 0x80, 0x3e}, {0.25f, 0, 0, 1});
  expect(VK_FORMAT_R32G32_SFLOAT, {0, 0, 0x80, 0x3e, 0, 0, 0x80, 0xbf}, {0.25f, -1, 0, 1});
  expect(VK_FORMAT_R32G32B32A32_SFLOAT, {0, 0, 0x80, 0x3e, 0, 0, 0x80, 0xbf, 0, 0, 0, 0, 0, 0, 0, 0x40}, {0.25f, -1, 0, 2});
}

TEST(DumpFile, DecodesPackedFormatsAndDepth) {
  expect(VK_FORMAT_B10G11R11_UFLOAT_PACK32, {0xc0, 0x03, 0x1c, 0x70}, {1, 0.5f, 0.5f, 1});
  expect(VK_FORMAT_A2B10G10R10_UNORM_PACK32, {0xff, 0x03, 0x00, 0xc0}, {1, 0, 0, 1});
  expect(VK_FORMAT_D16_UNORM, {0xff, 0xff}, {1, 0, 0, 1});
  expect(VK_FORMAT_X8_D24_UNORM_PACK32, {0xff, 0xff, 0xff, 0x12}, {1, 0, 0, 1});
  expect(VK_FORMAT_D32_SFLOAT, {0, 0, 0, 0x3f}, {0.5f, 0, 0, 1});
  expect(VK_FORMAT_S8_UINT, {7}, {7, 0, 0, 1});
  const auto unknown = decode_dump(texel_of(VK_FORMAT_BC1_RGB_UNORM_BLOCK, {0, 0, 0, 0, 0, 0, 0, 0}));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::unsupported);
}

class DumpFolder : public testing::Test {
 protected:
  DumpFolder() { fs::create_directories(folder); }
  ~DumpFolder() override { fs::remove_all(folder); }
  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  template <class T>
  static T at(const std::string& bytes, size_t offset) {
    T value{};
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, &bytes[offset], sizeof value);
    return value;
  }
  fs::path folder = fs::path(testing::TempDir()) / ("dump_file_" + std::to_string(::getpid()));
};

// Two layers of 3x2, one below the other; the first channel counts the texels.
Dump counted() {
  Dump dump;
  dump.format = static_cast<Format>(VK_FORMAT_R32_SFLOAT);
  dump.width = 3, dump.height = 2, dump.depth_or_layers = 2, dump.bytes_per_texel = 4;
  dump.bytes.resize(12 * 4);
  for (uint32_t i = 0; i < 12; ++i) {
    const float value = static_cast<float>(i) / 8;
    std::memcpy(&dump.bytes[size_t{4} * i], &value, sizeof value);
  }
  return dump;
}

// Reads as OpenEXR 2 says: attributes up to an empty name, a table of offsets, and a block a line with its channels by name.
TEST_F(DumpFolder, ExrHoldsTheValuesAsTheyAre) {
  const auto files = write_dump(folder, "pass.image", counted());
  ASSERT_TRUE(files) << files.error().message;
  ASSERT_EQ(*files, (std::vector<std::string>{(folder / "pass.image.exr").string(), (folder / "pass.image.png").string()}));
  const std::string exr = read(files->front());
  ASSERT_EQ(at<uint32_t>(exr, 0), 20000630u);
  ASSERT_EQ(at<uint32_t>(exr, 4), 2u);
  size_t place = 8;
  std::vector<std::string> names;
  while (place < exr.size() && exr[place] != '\0') {
    names.emplace_back(exr.c_str() + place);
    place += names.back().size() + 1;
    place += std::strlen(exr.c_str() + place) + 1;  // its type
    const auto bytes = at<int32_t>(exr, place);
    if (names.back() == "dataWindow") {
      EXPECT_EQ(at<int32_t>(exr, place + 12), 2);
      EXPECT_EQ(at<int32_t>(exr, place + 16), 3);
    }
    if (names.back() == "channels") {
      EXPECT_EQ(bytes, 4 * 18 + 1);
    }
    place += 4 + static_cast<size_t>(bytes);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"channels", "compression", "dataWindow", "displayWindow", "lineOrder", "pixelAspectRatio",
                                             "screenWindowCenter", "screenWindowWidth"}));
  ++place;
  for (uint32_t y = 0; y < 4; ++y) {
    const auto line = static_cast<size_t>(at<uint64_t>(exr, place + size_t{8} * y));
    EXPECT_EQ(at<int32_t>(exr, line), static_cast<int32_t>(y));
    EXPECT_EQ(at<int32_t>(exr, line + 4), 3 * 16);
    for (uint32_t x = 0; x < 3; ++x) {
      EXPECT_EQ(at<float>(exr, line + 8 + size_t{4} * x), 1.0f) << "A";
      EXPECT_EQ(at<float>(exr, line + 8 + size_t{4} * (9 + x)), static_cast<float>(3 * y + x) / 8) << "R";
    }
  }
  EXPECT_EQ(exr.size(), place + 4 * 8 + 4 * (8 + 3 * 16));
}

TEST_F(DumpFolder, PngHasTheSizeAndBuffersAreLeftAsTheyAre) {
  const auto files = write_dump(folder, "p", counted());
  ASSERT_TRUE(files);
  const std::string png = read(files->back());
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\3\0\0\0\4", 8));
  Dump buffer;
  buffer.format = Format::undefined;
  for (const char c : {'a', '\0', 'c'}) buffer.bytes.push_back(static_cast<std::byte>(c));
  const auto raw = write_dump(folder, "b", buffer);
  ASSERT_TRUE(raw);
  ASSERT_EQ(*raw, std::vector<std::string>{(folder / "b.bin").string()});
  EXPECT_EQ(read(raw->front()), std::string("a\0c", 3));
  const auto lost = write_dump(folder / "gone", "b", buffer);
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().code, ErrorCode::io);
}

}  // namespace
}  // namespace rg::demo
