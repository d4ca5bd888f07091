#pragma once

#include <cstdlib>
#include <optional>
#include <stdlib.h>
#include <string>

namespace packtrace::test {

/// Sets an environment variable for the lifetime of the object; unsets the variable without a
/// value.
class ScopedVariable {
public:
    ScopedVariable(const char* name, const std::optional<std::string>& value) : name_(name)
    {
        if (const char* old = std::getenv(name))
            old_ = old;
        assign(value);
    }
    ~ScopedVariable()
    {
        assign(old_);
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

private:
    void assign(const std::optional<std::string>& value) const
    {
        if (value)
            setenv(name_, value->c_str(), 1);
        else
            unsetenv(name_);
    }

    const char* name_;
    std::optional<std::string> old_;
};

}  // namespace packtrace::test
