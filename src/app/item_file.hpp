#pragma once
// Where the widgets are, in a file: so that a test can click in the real window what a person clicks.

#include "editor/widgets/item_recorder.hpp"

#include <filesystem>

namespace fascicle::app {

/// Records from its making to its end. An empty path: nothing.
class ItemFile {
public:
    explicit ItemFile(std::filesystem::path path);
    ~ItemFile();
    ItemFile(const ItemFile&) = delete;
    ItemFile& operator=(const ItemFile&) = delete;

    /// After a frame: "name<TAB>x0<TAB>y0<TAB>x1<TAB>y1" a line, pixels, when something has moved.
    void write();

private:
    std::filesystem::path path_;
    editor::ItemRecorder recorder_;
    std::string written_;
};

} // namespace fascicle::app
