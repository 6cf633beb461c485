#include "app/cli/frame_range.hpp"

#include "app/cli/options.hpp"
#include "fascicle/base/error.hpp"

namespace fascicle::app {

FrameRange read_frame_range(const std::string& text) {
    const std::string expected = "FIRST:LAST or FIRST:LAST:STEP, e.g. 0:300:5; LAST may be left out";
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() < 2 || parts.size() > 3)
        throw_error("--frames", "got '" + text + "'", expected, ErrorKind::usage);
    FrameRange range;
    const int most = 10'000'000;
    range.first = read_whole("--frames", parts[0], 0, most);
    if (!parts[1].empty())
        range.last = read_whole("--frames", parts[1], range.first, most);
    if (parts.size() == 3)
        range.step = read_whole("--frames", parts[2], 1, most);
    return range;
}

} // namespace fascicle::app
