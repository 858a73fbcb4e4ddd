#include "xcb_window.h"

#include <cstdlib>
#include <cstring>
#include <fstream>

namespace {
xcb_atom_t find_atom(xcb_connection_t* connection, const char* name) {
  const auto cookie = xcb_intern_atom(connection, 0, static_cast<uint16_t>(std::strlen(name)), name);
  xcb_intern_atom_reply_t* reply = xcb_intern_atom_reply(connection, cookie, nullptr);
  const xcb_atom_t atom = reply != nullptr ? reply->atom : xcb_atom_t{XCB_ATOM_NONE};
  std::free(reply);
  return atom;
}
}  // namespace

XcbWindow::XcbWindow(uint16_t width, uint16_t height, const char* title) : width_(width), height_(height) {
  connection_ = xcb_connect(nullptr, nullptr);
  if (xcb_connection_has_error(connection_) != 0) return;
  const xcb_screen_t* screen = xcb_setup_roots_iterator(xcb_get_setup(connection_)).data;
  window_ = xcb_generate_id(connection_);
  const uint32_t events = XCB_EVENT_MASK_STRUCTURE_NOTIFY;
  xcb_create_window(connection_, XCB_COPY_FROM_PARENT, window_, screen->root, 0, 0, width, height, 0, XCB_WINDOW_CLASS_INPUT_OUTPUT,
                    screen->root_visual, XCB_CW_EVENT_MASK, &events);
  xcb_change_property(connection_, XCB_PROP_MODE_REPLACE, window_, XCB_ATOM_WM_NAME, XCB_ATOM_STRING, 8, static_cast<uint32_t>(std::strlen(title)),
                      title);
  const xcb_atom_t protocols = find_atom(connection_, "WM_PROTOCOLS");
  delete_window_ = find_atom(connection_, "WM_DELETE_WINDOW");
  xcb_change_property(connection_, XCB_PROP_MODE_REPLACE, window_, protocols, XCB_ATOM_ATOM, 32, 1, &delete_window_);
  xcb_map_window(connection_, window_);
  xcb_flush(connection_);
  open_ = true;
}

XcbWindow::~XcbWindow() {
  if (window_ != 0) xcb_destroy_window(connection_, window_);
  xcb_disconnect(connection_);
}

void XcbWindow::poll() {
  while (xcb_generic_event_t* event = xcb_poll_for_event(connection_)) {
    const int type = event->response_type & 0x7f;
    if (type == XCB_CONFIGURE_NOTIFY) {
      const auto* configured = reinterpret_cast<const xcb_configure_notify_event_t*>(event);
      width_ = configured->width, height_ = configured->height;
    }
    if (type == XCB_CLIENT_MESSAGE) open_ &= reinterpret_cast<const xcb_client_message_event_t*>(event)->data.data32[0] != delete_window_;
    std::free(event);
  }
  open_ &= xcb_connection_has_error(connection_) == 0;
}

void XcbWindow::resize(uint16_t width, uint16_t height) {
  const uint32_t values[] = {width, height};
  xcb_configure_window(connection_, window_, XCB_CONFIG_WINDOW_WIDTH | XCB_CONFIG_WINDOW_HEIGHT, values);
  xcb_flush(connection_);
}

bool XcbWindow::write_screenshot(const std::string& path) const {
  const auto cookie =
      xcb_get_image(connection_, XCB_IMAGE_FORMAT_Z_PIXMAP, window_, 0, 0, static_cast<uint16_t>(width_), static_cast<uint16_t>(height_), ~0u);
  xcb_get_image_reply_t* reply = xcb_get_image_reply(connection_, cookie, nullptr);
  if (reply == nullptr) return false;
  const uint8_t* pixels = xcb_get_image_data(reply);  // blue, green, red, unused
  std::ofstream file(path, std::ios::binary);
  file << "P6 " << width_ << ' ' << height_ << " 255\n";
  for (size_t i = 0; i < size_t{width_} * height_; ++i)
    for (const int channel : {2, 1, 0}) file.put(static_cast<char>(pixels[4 * i + static_cast<size_t>(channel)]));
  std::free(reply);
  return static_cast<bool>(file.flush());
}
