#pragma once
// A linked GL program and its uniforms.

#include "render/draw_list.hpp"

#include <string>
#include <unordered_map>

namespace fascicle::render {

class Shader {
public:
    /// Compiles and links; `geometry` may be empty. The "#version" line and the shared functions are put in
    /// front by us. Error with the shader's name and the driver's log.
    Shader(const std::string& name, const std::string& vertex, const std::string& fragment,
           const std::string& geometry = {});
    ~Shader();
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    void use() const;
    /// The setters need use() before. A uniform that the compiler optimised away is ignored.
    void set(const char* uniform, int value);
    void set(const char* uniform, float value);
    void set(const char* uniform, float x, float y);
    void set(const char* uniform, const Rgba& value);
    /// Column-major 3x3 and 4x4.
    void set_mat3(const char* uniform, const float* values);
    void set_mat4(const char* uniform, const float* values);

private:
    int location(const char* uniform);

    unsigned program_ = 0;
    std::unordered_map<std::string, int> locations_;
};

} // namespace fascicle::render
