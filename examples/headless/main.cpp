// Renders a frame without a window and writes it as a picture: headless [FILE.ppm]
#include <cstdio>
#include <fstream>
#include <string>

#include "glow.h"

namespace {

int complain(const rg::Error& error) {
  std::fprintf(stderr, "headless: %s\n", error.message.c_str());
  return 1;
}

bool write_ppm(const char* path, uint32_t width, uint32_t height, std::span<const uint32_t> pixels) {
  std::ofstream file(path, std::ios::binary);
  file << "P6 " << width << ' ' << height << " 255\n";
  for (const uint32_t pixel : pixels)
    for (const int shift : {0, 8, 16}) file.put(static_cast<char>(pixel >> shift & 0xff));
  return static_cast<bool>(file.flush());
}

}  // namespace

int main(int argc, char** argv) {
  const char* path = argc > 1 ? argv[1] : "glow.ppm";
  auto device = rg::Device::create({});
  if (!device) return complain(device.error());

  const glow::Extents extents{.view = {256, 128}};
  auto frame = glow::Frame::create(*device, extents);  // memory, pipelines, descriptors: once
  if (!frame) return complain(frame.error());

  glow::Params params;
  params.camera = {.sun = {0.7f, 0.3f}, .exposure = 0.8f, .bands = 16};
  for (int i = 0; i < 3; ++i) {  // a frame walks tables: no allocation, no lookup
    params.camera.sun.x = 0.6f + 0.05f * static_cast<float>(i);
    if (const rg::Status done = frame->execute(params); !done) return complain(done.error());
  }
  const auto pixels = frame->pixels();  // waits for the last frame
  if (!pixels) return complain(pixels.error());
  if (!write_ppm(path, extents.view.width, extents.view.height, *pixels)) return complain({rg::ErrorCode::io, std::string("cannot write ") + path});
  std::printf("%s on %s\n", path, std::string(device->name()).c_str());
  return 0;
}
