// The parts that make_plaza() puts together, in this order. All append to the workshop's scene.
#pragma once

#include <string>
#include <vector>

#include "examples/demo/bake.h"
#include "examples/demo/mesh_builder.h"
#include "examples/demo/scene.h"

namespace rg::demo {

// The plan, metres. The court is open; a covered walk runs around it.
namespace plan {
constexpr float court_x = 14, court_z = 10;          // half sizes
constexpr float walk = 3.5f;                         // width of the covered walk
constexpr float bay = 4;                             // between columns
constexpr float walk_floor = 0.15f, terrace = 0.9f;  // the northern walk is a terrace
constexpr float spring = 3.55f;                      // where arches begin
constexpr float upper = 5.85f, eaves = 9.6f;         // upper floor
constexpr float hall_x = 7, hall_front = -court_z - walk, hall_back = -22, hall_ceiling = 5.6f;
}  // namespace plan

namespace paint_of {
enum : uint32_t {
  granite,
  plaster,
  ochre,
  brick,
  marble,
  dark_marble,
  planks,
  beams,
  roof,
  sandstone,
  mosaic,
  bronze,
  gold,
  rug,
  leaves,
  verdigris,
  terracotta,
  plain_white,
  glow_warm,
  glow_teal,
  glow_rose,
  embers,
  glass,
  water,
  green_glass,
  rose_screen,
  count
};
}

struct Workshop {
  Scene scene;
  std::vector<Box> solids;            // what hides the sky
  std::vector<float> texture_metres;  // by material: side of one repeat
};

// Appends a mesh with its one instance; texture coordinates become repeats of the material's texture.
uint32_t place(Workshop& shop, std::string name, uint32_t material, MeshData data);
// A box; large ones also hide the sky.
void place_box(Workshop& shop, std::string name, uint32_t material, glm::vec3 low, glm::vec3 high, float cell = 1);
void place_prop(Workshop& shop, uint32_t mesh, glm::vec3 at, float turn = 0, Animation animation = {}, glm::vec3 tint = glm::vec3(1));
float random_unit(uint32_t seed);  // [0, 1)

void make_materials(Workshop& shop);
void build_court(Workshop& shop);    // paving, steps, fountain, planters
void build_arcades(Workshop& shop);  // columns, arches, walks, upper floors, roofs
void build_hall(Workshop& shop);     // the room
void build_props(Workshop& shop);    // lanterns, strings of bulbs, banners, barrels
void hang_lights(Workshop& shop);
void put_on_shows(Workshop& shop);  // lamps that throw pictures, have shadows or an extent, or take light away
void keep_inside(Light& light);     // a lamp of the hall shines in the hall only

// Bulbs of the strings over the court, shared by props and lights.
struct Bulb {
  glm::vec3 position, color;
};
std::vector<std::vector<Bulb>> strings_of_bulbs();
std::vector<glm::vec3> column_places();  // foot of each
std::vector<glm::vec3> hanging_lantern_places();
std::vector<glm::vec3> lantern_post_places();
std::vector<glm::vec3> candle_places();

}  // namespace rg::demo
