#include "examples/demo/app.h"

int main(int argc, char** argv) { return rg::demo::run_demo(argc, argv); }
