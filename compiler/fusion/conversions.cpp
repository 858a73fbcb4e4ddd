#include "compiler/fusion/conversions.h"

#include "compiler/shaders/glsl_types.h"
#include "dsl/format_table.h"

namespace rg::compiler {
namespace {

using dsl::Format;
using dsl::Numeric;

std::string vector_of(const std::string& scalar, uint32_t count) {
  if (count == 1) return scalar;
  const std::string prefix = scalar == "float" ? "" : scalar == "uint" ? "u" : "i";
  return prefix + "vec" + std::to_string(count);
}

bool is_small_float(Format format) { return format == Format::r16f || format == Format::rg16f || format == Format::rgba16f; }

std::string list_of(uint32_t count, const std::string& type, const std::string& function, const std::string& rest) {
  std::string list;
  for (uint32_t i = 0; i < count; ++i) list += (i == 0 ? "" : ", ") + function + "(v" + (count == 1 ? "" : std::string(".") + "xyzw"[i]) + rest + ")";
  return "return " + (count == 1 ? list : type + "(" + list + ")") + ";";
}

std::string half_body(uint32_t count, const std::string& type, HalfRounding rounding) {
  if (rounding == HalfRounding::zero) return list_of(count, type, "rg_to_half", "");
  if (count == 1) return "return unpackHalf2x16(packHalf2x16(vec2(v, 0.0))).x;";
  if (count == 2) return "return unpackHalf2x16(packHalf2x16(v));";
  return "return vec4(unpackHalf2x16(packHalf2x16(v.xy)), unpackHalf2x16(packHalf2x16(v.zw)));";
}

// Unsigned floats of five bits of exponent and `mantissa` of fraction lie in the upper bits of a half.
std::string small_floats() {
  return "float rg_to_unsigned_float(float v, uint mantissa) {\n"
         "  if (isnan(v)) return v;\n"
         "  if (!(v > 0.0)) return 0.0;\n"
         "  if (isinf(v)) return v;\n"
         "  uint bits = floatBitsToUint(v), lost = 23u - mantissa;\n"
         "  if (bits >= 0x38800000u) return min(uintBitsToFloat(bits >> lost << lost), uintBitsToFloat(0x47000000u | 0x7FFFFFu >> lost << lost));\n"
         "  float unit = uintBitsToFloat((127u - 14u - mantissa) << 23);\n"
         "  return floor(v / unit) * unit;\n"
         "}\n"
         "float rg_to_half(float v) {\n"
         "  return uintBitsToFloat(floatBitsToUint(rg_to_unsigned_float(abs(v), 10u)) | (floatBitsToUint(v) & 0x80000000u));\n"
         "}\n";
}

uint32_t bits_of(Format format, uint32_t component) {
  if (format == Format::rgb10a2 || format == Format::rgb10a2ui) return component == 3 ? 2 : 10;
  return dsl::info(format).block_bytes * 8 / components(format);
}

std::string per_component(Format format, const std::string& type, const std::string& function) {
  const uint32_t count = components(format);
  std::string list;
  for (uint32_t i = 0; i < count; ++i)
    list +=
        (i == 0 ? "" : ", ") + function + "(v" + (count == 1 ? "" : std::string(".") + "xyzw"[i]) + ", " + std::to_string(bits_of(format, i)) + "u)";
  return "return " + (count == 1 ? list : type + "(" + list + ")") + ";";
}

const char* helper(Format format) {
  switch (dsl::info(format).numeric) {
    case Numeric::unorm:
      return "float rg_to_unorm(float v, uint bits) { float most = float((1u << bits) - 1u); return float(uint(roundEven(max(min(v, 1.0), 0.0) * "
             "most))) / most; }\n";
    case Numeric::snorm:
      return "float rg_to_snorm(float v, uint bits) {\n"  // there is no negative zero
             "  float most = float((1u << (bits - 1u)) - 1u);\n"
             "  int q = int(roundEven(max(min(v, 1.0), -1.0) * most));\n"
             "  return (q < 0 ? -1.0 : 1.0) * (float(abs(q)) / most);\n"
             "}\n";
    case Numeric::uint:
      return "uint rg_to_uint(uint v, uint bits) { return min(v, (1u << bits) - 1u); }\n";
    case Numeric::sint:
      return "int rg_to_sint(int v, uint bits) { int most = int((1u << (bits - 1u)) - 1u); return clamp(v, -most - 1, most); }\n";
    default:
      return "";
  }
}

bool loses_nothing(Format format) {
  const dsl::FormatInfo& info = dsl::info(format);
  if (!info.is_color()) return true;
  const bool wide = info.numeric == Numeric::floating || info.is_integer();
  return wide && info.block_bytes == 4 * components(format) && format != Format::r11g11b10f && format != Format::rgb10a2ui;
}

std::string body(Format format, const std::string& type, HalfRounding rounding) {
  if (format == Format::r11g11b10f)
    return "return vec3(rg_to_unsigned_float(v.x, 6u), rg_to_unsigned_float(v.y, 6u), rg_to_unsigned_float(v.z, 5u));";
  if (is_small_float(format)) return half_body(components(format), type, rounding);
  switch (dsl::info(format).numeric) {
    case Numeric::unorm:
      return per_component(format, type, "rg_to_unorm");
    case Numeric::snorm:
      return per_component(format, type, "rg_to_snorm");
    case Numeric::uint:
      return per_component(format, type, "rg_to_uint");
    default:
      return per_component(format, type, "rg_to_sint");
  }
}

std::string function_name(Format format) { return std::string("rg_to_") + dsl::name(format); }

}  // namespace

std::string texel_type(Format format, uint32_t aspects) {
  const char kind = texel_kind(format, aspects);
  return vector_of(kind == 'f' ? "float" : kind == 'u' ? "uint" : "int", components(format));
}

std::string conversion_call(Format format, const std::string& name) {
  return loses_nothing(format) ? "" : name + " = " + function_name(format) + "(" + name + ");";
}

std::string conversion_text(Format format, HalfRounding rounding) {
  if (loses_nothing(format)) return "";
  const std::string type = texel_type(format, dsl::aspect_color);
  const bool floats = format == Format::r11g11b10f || is_small_float(format);
  const std::string guard = std::string("RG_HELPER_") + (floats ? "FLOATS" : std::to_string(static_cast<int>(dsl::info(format).numeric)));
  const std::string helpers = floats ? small_floats() : helper(format);
  const std::string once = helpers.empty() ? "" : "#ifndef " + guard + "\n#define " + guard + "\n" + helpers + "#endif\n";
  return once + type + " " + function_name(format) + "(" + type + " v) { " + body(format, type, rounding) + " }\n";
}

}  // namespace rg::compiler
