#include "render/osmesa_context.hpp"

#include "fascicle/base/error.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>

namespace fascicle::render {

namespace {

constexpr int dummy_size = 64;

// The four entry points; the library stays open for the rest of the process, because Mesa leaves threads
// behind.
struct Library {
    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaGetProcAddress) get_address = nullptr;
};

Library loaded;

Library open_library(const std::vector<std::string>& names) {
    void* handle = nullptr;
    std::string tried;
    for (const std::string& name : names) {
        handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle != nullptr)
            break;
        tried += (tried.empty() ? "" : ", ") + name;
    }
    if (handle == nullptr)
        throw_error("drawing without a window", "cannot open the OSMesa library (tried " + tried + ")",
                    "the package libosmesa6 to be installed");
    Library library;
    const auto find = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle, name));
        if (function == nullptr)
            throw_error("drawing without a window", std::string("the OSMesa library has no function ") + name,
                        "Mesa 12 or newer");
    };
    find(library.create, "OSMesaCreateContextAttribs");
    find(library.destroy, "OSMesaDestroyContext");
    find(library.make_current, "OSMesaMakeCurrent");
    find(library.get_address, "OSMesaGetProcAddress");
    return library;
}

} // namespace

const std::vector<std::string>& OsmesaContext::default_libraries() {
    static const std::vector<std::string> names{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    return names;
}

OsmesaContext::OsmesaContext(const std::vector<std::string>& libraries) {
    loaded = open_library(libraries);
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0,
                              0};
    context_ = loaded.create(attributes, nullptr);
    if (context_ == nullptr)
        throw_error("drawing without a window", "OSMesa cannot make an OpenGL 3.3 core context");
    try {
        dummy_.resize(std::size_t{4} * dummy_size * dummy_size);
        make_current();
        load_gl_functions([](const char* name) { return reinterpret_cast<void*>(loaded.get_address(name)); });
    } catch (...) {
        loaded.destroy(static_cast<OSMesaContext>(context_));
        throw;
    }
}

OsmesaContext::~OsmesaContext() {
    loaded.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    loaded.destroy(static_cast<OSMesaContext>(context_));
}

void OsmesaContext::make_current() {
    if (loaded.make_current(static_cast<OSMesaContext>(context_), dummy_.data(), GL_UNSIGNED_BYTE, dummy_size,
                            dummy_size) == GL_FALSE)
        throw_error("drawing without a window", "OSMesa cannot make its context current");
}

} // namespace fascicle::render
