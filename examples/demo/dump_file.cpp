#include "examples/demo/dump_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/gtc/packing.hpp>

#include "examples/demo/png.h"

namespace rg::demo {
namespace {

// ---- texels -----------------------------------------------------------------------------------------------------------

// Vulkan numbers the formats of a layout in this order; 32-bit ones have only the last three.
enum class Numeric : uint8_t { unorm, snorm, uscaled, sscaled, uint, sint, last };  // last: srgb of 8 bits, floats else

struct TexelLayout {
  uint32_t first = 0, channels = 0, bits = 0;
  bool blue_first = false;
};
constexpr TexelLayout kLayouts[] = {
    {VK_FORMAT_R8_UNORM, 1, 8},
    {VK_FORMAT_R8G8_UNORM, 2, 8},
    {VK_FORMAT_R8G8B8A8_UNORM, 4, 8},
    {VK_FORMAT_B8G8R8A8_UNORM, 4, 8, true},
    {VK_FORMAT_R16_UNORM, 1, 16},
    {VK_FORMAT_R16G16_UNORM, 2, 16},
    {VK_FORMAT_R16G16B16A16_UNORM, 4, 16},
    {VK_FORMAT_R32_UINT, 1, 32},
    {VK_FORMAT_R32G32_UINT, 2, 32},
    {VK_FORMAT_R32G32B32A32_UINT, 4, 32},
};

const TexelLayout* find_layout(uint32_t format) {
  for (const TexelLayout& layout : kLayouts)
    if (format >= layout.first && format < layout.first + (layout.bits == 32 ? 3 : 7)) return &layout;
  return nullptr;
}

template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

float decode8(const std::byte* at, Numeric numeric) {
  const auto u = load<uint8_t>(at);
  const auto s = load<int8_t>(at);
  switch (numeric) {
    case Numeric::unorm:
      return static_cast<float>(u) / 255;
    case Numeric::snorm:
      return std::max(static_cast<float>(s) / 127, -1.0f);
    case Numeric::last:
      return u <= 10 ? static_cast<float>(u) / 255 / 12.92f : std::pow((static_cast<float>(u) / 255 + 0.055f) / 1.055f, 2.4f);
    case Numeric::sscaled:
    case Numeric::sint:
      return s;
    default:
      return u;
  }
}
float decode16(const std::byte* at, Numeric numeric) {
  const auto u = load<uint16_t>(at);
  const auto s = load<int16_t>(at);
  switch (numeric) {
    case Numeric::unorm:
      return static_cast<float>(u) / 65535;
    case Numeric::snorm:
      return std::max(static_cast<float>(s) / 32767, -1.0f);
    case Numeric::last:
      return glm::unpackHalf1x16(u);
    case Numeric::sscaled:
    case Numeric::sint:
      return s;
    default:
      return u;
  }
}
float decode32(const std::byte* at, uint32_t step) {
  if (step == 0) return static_cast<float>(load<uint32_t>(at));
  return step == 1 ? static_cast<float>(load<int32_t>(at)) : load<float>(at);
}

void decode_channels(const TexelLayout& layout, uint32_t format, const std::byte* at, float* out) {
  for (uint32_t channel = 0; channel < layout.channels; ++channel) {
    const std::byte* value = at + channel * layout.bits / 8;
    const uint32_t step = format - layout.first;
    const bool linear = channel == 3 && step == static_cast<uint32_t>(Numeric::last);  // alpha of an sRGB format
    out[channel] = layout.bits == 8    ? decode8(value, linear ? Numeric::unorm : static_cast<Numeric>(step))
                      : layout.bits == 16 ? decode16(value, static_cast<Numeric>(step))
                                       : decode32(value, step);
  }
  if (layout.blue_first) std::swap(out[0], out[2]);
}

// Those that are laid out like nothing else. False: unknown.
bool decode_special(uint32_t format, const std::byte* at, float* out) {
  switch (format) {
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32: {
      const glm::vec3 value = glm::unpackF2x11_1x10(load<uint32_t>(at));
      std::copy_n(&value.x, 3, out);
      return true;
    }
    case VK_FORMAT_A2B10G10R10_UNORM_PACK32: {
      const glm::vec4 value = glm::unpackUnorm3x10_1x2(load<uint32_t>(at));
      std::copy_n(&value.x, 4, out);
      return true;
    }
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_D16_UNORM_S8_UINT:
      out[0] = decode16(at, Numeric::unorm);
      return true;
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
      out[0] = static_cast<float>(load<uint32_t>(at) & 0xffffff) / 0xffffff;
      return true;
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      out[0] = load<float>(at);
      return true;
    case VK_FORMAT_S8_UINT:
      out[0] = load<uint8_t>(at);
      return true;
    default:
      return false;
  }
}

// ---- files --------------------------------------------------------------------------------------------------------------

class Bytes {
 public:
  template <class T>
  Bytes& put(T value) {
    const auto* raw = reinterpret_cast<const char*>(&value);
    data_.append(raw, sizeof value);
    return *this;
  }
  Bytes& text(std::string_view value) {
    data_.append(value).push_back('\0');
    return *this;
  }
  template <class... Values>
  Bytes& attribute(std::string_view name, std::string_view type, Values... values) {
    text(name).text(type).put(static_cast<int32_t>((sizeof values + ...)));
    (put(values), ...);
    return *this;
  }
  size_t size() const { return data_.size(); }
  const std::string& data() const { return data_; }

 private:
  std::string data_;
};

Status write_file(const std::filesystem::path& path, std::string_view data) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  std::ofstream file(temporary, std::ios::binary);
  file.write(data.data(), static_cast<std::streamsize>(data.size()));
  file.close();
  std::error_code failed;
  if (file) std::filesystem::rename(temporary, path, failed);
  if (file && !failed) return Done{};
  std::filesystem::remove(temporary, failed);
  return Error{ErrorCode::io, "`" + path.string() + "` cannot be written; choose another folder with --out"};
}

Bytes exr_header(const FloatPicture& picture) {
  Bytes out;
  constexpr int32_t kFloat = 2;
  const auto right = static_cast<int32_t>(picture.width) - 1, bottom = static_cast<int32_t>(picture.height) - 1;
  out.put(uint32_t{20000630}).put(uint32_t{2});
  out.text("channels").text("chlist").put(int32_t{4 * 18 + 1});
  for (const char* name : {"A", "B", "G", "R"}) out.text(name).put(kFloat).put(uint32_t{0}).put(int32_t{1}).put(int32_t{1});
  out.put('\0');
  out.attribute("compression", "compression", '\0');
  out.attribute("dataWindow", "box2i", int32_t{0}, int32_t{0}, right, bottom);
  out.attribute("displayWindow", "box2i", int32_t{0}, int32_t{0}, right, bottom);
  out.attribute("lineOrder", "lineOrder", '\0');
  out.attribute("pixelAspectRatio", "float", 1.0f);
  out.attribute("screenWindowCenter", "v2f", 0.0f, 0.0f);
  out.attribute("screenWindowWidth", "float", 1.0f);
  out.put('\0');
  return out;
}

Picture to_picture(const FloatPicture& in) {
  Picture out{in.width, in.height, std::vector<uint8_t>(in.texels.size())};
  for (size_t i = 0; i < in.texels.size(); ++i) {
    const bool alpha = i % 4 == 3;  // a picture of it would be invisible where alpha is 0
    out.texels[i] = alpha ? 255 : static_cast<uint8_t>(std::lround(std::clamp(std::isnan(in.texels[i]) ? 0.0f : in.texels[i], 0.0f, 1.0f) * 255));
  }
  return out;
}

}  // namespace

Result<FloatPicture> decode_dump(const Dump& dump) {
  const auto format = static_cast<uint32_t>(dump.format);
  const TexelLayout* layout = find_layout(format);
  FloatPicture out{dump.width, dump.height * dump.depth_or_layers, {}};
  out.texels.resize(size_t{out.width} * out.height * 4);
  for (size_t i = 0; i < out.texels.size() / 4; ++i) {
    float* texel = &out.texels[4 * i];
    texel[3] = 1;
    const std::byte* at = dump.bytes.data() + i * dump.bytes_per_texel;
    if (layout != nullptr)
      decode_channels(*layout, format, at, texel);
    else if (!decode_special(format, at, texel))
      return Error{ErrorCode::unsupported, "texels of format " + std::to_string(format) + " cannot be decoded"};
  }
  return out;
}

Status write_exr(const std::filesystem::path& path, const FloatPicture& picture) {
  Bytes out = exr_header(picture);
  const size_t line = 8 + size_t{16} * picture.width, first = out.size() + size_t{8} * picture.height;
  for (uint32_t y = 0; y < picture.height; ++y) out.put(static_cast<uint64_t>(first + line * y));
  for (uint32_t y = 0; y < picture.height; ++y) {
    out.put(static_cast<int32_t>(y)).put(static_cast<int32_t>(line - 8));
    for (const uint32_t channel : {3u, 2u, 1u, 0u})
      for (uint32_t x = 0; x < picture.width; ++x) out.put(picture.texels[(size_t{y} * picture.width + x) * 4 + channel]);
  }
  return write_file(path, out.data());
}

Result<std::vector<std::string>> write_dump(const std::filesystem::path& folder, const std::string& name, const Dump& dump) {
  const std::filesystem::path base = folder / name;
  if (dump.format == Format::undefined) {
    const std::string file = base.string() + ".bin";
    if (Status written = write_file(file, {reinterpret_cast<const char*>(dump.bytes.data()), dump.bytes.size()}); !written) return written.error();
    return std::vector<std::string>{file};
  }
  const auto picture = decode_dump(dump);
  if (!picture) return picture.error();
  const std::string exr = base.string() + ".exr", png = base.string() + ".png";
  if (Status written = write_exr(exr, *picture); !written) return written.error();
  if (Status written = write_png(png, to_picture(*picture)); !written) return written.error();
  return std::vector<std::string>{exr, png};
}

}  // namespace rg::demo
