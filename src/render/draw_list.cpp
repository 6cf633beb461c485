#include "render/draw_list.hpp"
