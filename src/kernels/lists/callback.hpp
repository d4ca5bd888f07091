#pragma once

namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Signature>
class Callback;

/// A callable of the caller's, called through a pointer: what takes one is compiled once, and not
/// for each of its callers. It holds no copy of the callable.
template <class Result, class... Arguments>
class Callback<Result(Arguments...)> {
public:
    /// None, which can't be called.
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
