#pragma once

namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Signature>
class Callback;

/// A reference to a callable, called through a pointer. A function with a Callback parameter is
/// compiled once, not once per callable. The callable is not copied.
template <class Result, class... Arguments>
class Callback<Result(Arguments...)> {
public:
    /// No callable; must not be called.
    Callback() = default;
    template <class Callable>
    explicit Callback(const Callable& callable)
        : callable_(&callable), call_([](const void* called, Arguments... arguments) -> Result {
              return (*static_cast<const Callable*>(called))(arguments...);
          })
    {
    }
    explicit operator bool() const
    {
        return call_ != nullptr;
    }
    Result operator()(Arguments... arguments) const
    {
        return call_(callable_, arguments...);
    }

private:
    const void* callable_ = nullptr;
    Result (*call_)(const void* called, Arguments... arguments) = nullptr;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
