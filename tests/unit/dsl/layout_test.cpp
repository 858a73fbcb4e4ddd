#include "dsl/layout.h"

#include <gtest/gtest.h>

#include "dsl/format_table.h"

namespace rg::dsl {
namespace {

struct Expected {
  const char* name;
  Type type;
  uint64_t size140, align140, size430, align430;
};

Type make(Scalar scalar, uint8_t rows, uint8_t columns = 1, uint32_t count = 0) {
  Type type;
  type.scalar = scalar;
  type.rows = rows;
  type.columns = columns;
  type.count = count;
  return type;
}

// OpenGL 4.6, 7.6.2.2, rules 1 to 10.
TEST(Layout, FollowsTheRulesOfTheSpecification) {
  const Expected kRows[] = {
      {"f32", make(Scalar::f32, 1), 4, 4, 4, 4},
      {"bool", make(Scalar::boolean, 1), 4, 4, 4, 4},
      {"vec2", make(Scalar::f32, 2), 8, 8, 8, 8},
      {"uvec3", make(Scalar::u32, 3), 12, 16, 12, 16},
      {"ivec4", make(Scalar::i32, 4), 16, 16, 16, 16},
      {"f32[3]", make(Scalar::f32, 1, 1, 3), 48, 16, 12, 4},
      {"vec2[3]", make(Scalar::f32, 2, 1, 3), 48, 16, 24, 8},
      {"vec3[2]", make(Scalar::f32, 3, 1, 2), 32, 16, 32, 16},
      {"mat3", make(Scalar::f32, 3, 3), 48, 16, 48, 16},
      {"mat3x4", make(Scalar::f32, 4, 3), 48, 16, 48, 16},
      {"mat4", make(Scalar::f32, 4, 4), 64, 16, 64, 16},
      {"mat4[2]", make(Scalar::f32, 4, 4, 2), 128, 16, 128, 16},
  };
  for (const Expected& row : kRows) {
    const TypeLayout a = layout_of({}, row.type, BlockLayout::std140), b = layout_of({}, row.type, BlockLayout::std430);
    EXPECT_EQ(a.size, row.size140) << row.name;
    EXPECT_EQ(a.align, row.align140) << row.name;
    EXPECT_EQ(b.size, row.size430) << row.name;
    EXPECT_EQ(b.align, row.align430) << row.name;
  }
}

Struct record(std::vector<Type> types) {
  Struct result;
  for (const Type& type : types) {
    Field field;
    field.name = "f" + std::to_string(result.fields.size());
    field.type = type;
    result.fields.push_back(std::move(field));
  }
  return result;
}

TEST(Layout, PackedFieldsAreAlignedToTheirBytesUpToAWord) {
  Table<StructId, Struct> structs;
  Struct vertex = record({make(Scalar::f32, 3), packed_type(Format::rgba8), packed_type(Format::r8), packed_type(Format::rg8_snorm),
                          packed_type(Format::rgba16f), packed_type(Format::r16ui)});
  vertex.fields[2].type.count = 3;
  for (const bool scalar : {false, true}) {
    ASSERT_TRUE(lay_out(structs, vertex, scalar));
    const uint32_t offsets[] = {0, 12, 16, 20, 24, 32};
    for (size_t i = 0; i < 6; ++i) EXPECT_EQ(vertex.fields[i].offset430, offsets[i]) << i;
    EXPECT_EQ(vertex.size430, scalar ? 36u : 48u);
  }
  const Type tint = packed_type(Format::rgba8), flags = packed_type(Format::rg16i);
  EXPECT_EQ(tint.rows, 4);
  EXPECT_EQ(tint.scalar, Scalar::f32);
  EXPECT_EQ(flags.rows, 2);
  EXPECT_EQ(flags.scalar, Scalar::i32);
}

TEST(Layout, VerticesTakeWhatEveryDeviceReads) {
  for (const Format format : {Format::rgba8, Format::rgba8_snorm, Format::rg16, Format::rgba16_snorm, Format::rg16f, Format::rgb10a2, Format::bgra8})
    EXPECT_TRUE(is_vertex_format(format)) << name(format);
  for (const Format format : {Format::rgba8_srgb, Format::bc1, Format::d16, Format::r11g11b10f, Format::rgb9e5, Format::rgb10a2ui, Format::none})
    EXPECT_FALSE(is_vertex_format(format)) << name(format);
}

TEST(Layout, StructsPadAndAgreeOrNot) {
  Table<StructId, Struct> structs;
  Struct tight = record({make(Scalar::f32, 3), make(Scalar::f32, 1), make(Scalar::f32, 4)});
  ASSERT_TRUE(lay_out(structs, tight));
  EXPECT_EQ(tight.fields[1].offset140, 12u);
  EXPECT_EQ(tight.size140, 32u);
  EXPECT_EQ(tight.size430, 32u);
  EXPECT_TRUE(layouts_agree(structs, tight));

  Struct loose = record({make(Scalar::f32, 1), make(Scalar::f32, 1, 1, 2), make(Scalar::u32, 1)});
  ASSERT_TRUE(lay_out(structs, loose));
  EXPECT_EQ(loose.fields[1].offset140, 16u);
  EXPECT_EQ(loose.fields[1].offset430, 4u);
  EXPECT_EQ(loose.fields[2].offset140, 48u);
  EXPECT_EQ(loose.fields[2].offset430, 12u);
  EXPECT_FALSE(layouts_agree(structs, loose));

  Struct small = record({make(Scalar::u32, 1)});
  ASSERT_TRUE(lay_out(structs, small));
  EXPECT_EQ(small.size140, 16u);
  EXPECT_EQ(small.size430, 4u);
  Type nested;
  nested.record = structs.add(small);
  Struct outer = record({make(Scalar::u32, 1), nested, make(Scalar::u32, 1)});
  ASSERT_TRUE(lay_out(structs, outer));
  EXPECT_EQ(outer.fields[1].offset140, 16u);
  EXPECT_EQ(outer.fields[2].offset140, 32u);
  EXPECT_EQ(outer.fields[2].offset430, 8u);
}

TEST(Layout, RefusesMoreThanTwoGiB) {
  Struct huge = record({make(Scalar::f32, 4, 4, 1u << 24), make(Scalar::f32, 4, 4, 1u << 24), make(Scalar::f32, 4, 4, 1u << 24)});
  EXPECT_FALSE(lay_out({}, huge));
}

}  // namespace
}  // namespace rg::dsl
