#include "fascicle/io/user_folder.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <optional>
#include <string>

using namespace fascicle;

namespace {

/// Sets a variable for the time of a test; null: not there.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name))
            old_ = old;
        value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
    }
    ~Variable() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }

private:
    const char* name_;
    std::optional<std::string> old_;
};

} // namespace

TEST_CASE("The user's folder follows FASCICLE_USER, then XDG_DATA_HOME, then HOME", "[io][user_folder]") {
    const Variable home("HOME", "/somewhere"), data("XDG_DATA_HOME", nullptr);
    {
        const Variable own("FASCICLE_USER", nullptr);
        CHECK(user_folder() == "/somewhere/.local/share/fascicle");
        const Variable xdg("XDG_DATA_HOME", "/data");
        CHECK(user_folder() == "/data/fascicle");
        const Variable relative("XDG_DATA_HOME", "not/absolute");
        CHECK(user_folder() == "/somewhere/.local/share/fascicle");
        const Variable none("HOME", nullptr);
        CHECK(user_folder().empty());
    }
    const Variable own("FASCICLE_USER", "/mine");
    CHECK(user_folder() == "/mine");
    const Variable off("FASCICLE_USER", "");
    CHECK(user_folder().empty());
}
