// A window of X11, as little of it as a picture needs.
#pragma once

#include <xcb/xcb.h>

#include <cstdint>
#include <string>

class XcbWindow {
 public:
  // Null connection() where there is no display.
  XcbWindow(uint16_t width, uint16_t height, const char* title);
  ~XcbWindow();
  XcbWindow(const XcbWindow&) = delete;
  XcbWindow& operator=(const XcbWindow&) = delete;

  bool open() const { return open_; }
  void poll();  // events; false from open() once the window was closed
  void resize(uint16_t width, uint16_t height);
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  // What the server shows, as a PPM file.
  bool write_screenshot(const std::string& path) const;

  xcb_connection_t* connection() const { return connection_; }
  xcb_window_t window() const { return window_; }

 private:
  xcb_connection_t* connection_ = nullptr;
  xcb_window_t window_ = 0;
  xcb_atom_t delete_window_ = 0;
  uint32_t width_, height_;
  bool open_ = false;
};
