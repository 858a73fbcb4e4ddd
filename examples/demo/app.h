// The demo as a program: options in, pictures and a table out.
#pragma once

namespace rg::demo {

// Exit codes: 0 done, 1 the input or the world is wrong, 2 the call is wrong.
int run_demo(int argc, char** argv);

}  // namespace rg::demo
