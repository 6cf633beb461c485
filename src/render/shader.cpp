#include "render/shader.hpp"

#include "fascicle/base/error.hpp"
#include "render/gl_functions.hpp"

namespace fascicle::render {

namespace {

unsigned compile(const std::string& name, GLenum stage, const std::string& source) {
    const unsigned shader = gl::CreateShader(stage);
    const std::string text = "#version 330 core\n" + source;
    const char* pointer = text.c_str();
    gl::ShaderSource(shader, 1, &pointer, nullptr);
    gl::CompileShader(shader);
    GLint done = 0;
    gl::GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == GL_FALSE) {
        char log[1024] = "";
        gl::GetShaderInfoLog(shader, sizeof log, nullptr, log);
        gl::DeleteShader(shader);
        throw_error("shader " + name, std::string("does not compile: ") + log);
    }
    return shader;
}

} // namespace

Shader::Shader(const std::string& name, const std::string& vertex, const std::string& fragment,
               const std::string& geometry) {
    program_ = gl::CreateProgram();
    try {
        const auto attach = [&](GLenum stage, const std::string& source) {
            const unsigned shader = compile(name, stage, source);
            gl::AttachShader(program_, shader);
            gl::DeleteShader(shader); // lives on until the program goes
        };
        attach(GL_VERTEX_SHADER, vertex);
        attach(GL_FRAGMENT_SHADER, fragment);
        if (!geometry.empty())
            attach(GL_GEOMETRY_SHADER, geometry);
        gl::LinkProgram(program_);
        GLint done = 0;
        gl::GetProgramiv(program_, GL_LINK_STATUS, &done);
        if (done == GL_FALSE) {
            char log[1024] = "";
            gl::GetProgramInfoLog(program_, sizeof log, nullptr, log);
            throw_error("shader " + name, std::string("does not link: ") + log);
        }
    } catch (...) {
        gl::DeleteProgram(program_);
        throw;
    }
}

Shader::~Shader() {
    gl::DeleteProgram(program_);
}

void Shader::use() const {
    gl::UseProgram(program_);
}

int Shader::location(const char* uniform) {
    const auto found = locations_.find(uniform);
    if (found != locations_.end())
        return found->second;
    return locations_[uniform] = gl::GetUniformLocation(program_, uniform);
}

void Shader::set(const char* uniform, int value) {
    gl::Uniform1i(location(uniform), value);
}

void Shader::set(const char* uniform, float value) {
    gl::Uniform1f(location(uniform), value);
}

void Shader::set(const char* uniform, float x, float y) {
    gl::Uniform2f(location(uniform), x, y);
}

void Shader::set(const char* uniform, const Rgba& value) {
    gl::Uniform4f(location(uniform), value[0], value[1], value[2], value[3]);
}

void Shader::set_mat3(const char* uniform, const float* values) {
    gl::UniformMatrix3fv(location(uniform), 1, GL_FALSE, values);
}

void Shader::set_mat4(const char* uniform, const float* values) {
    gl::UniformMatrix4fv(location(uniform), 1, GL_FALSE, values);
}

} // namespace fascicle::render
