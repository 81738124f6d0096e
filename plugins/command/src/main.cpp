#include "dispatch.hpp"

int main(int argc, char** argv) { return hauberk::command::dispatch({argv + 1, argv + argc}); }
