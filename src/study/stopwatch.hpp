#pragma once

namespace packtrace {

/// Times work that runs on some threads from its making on. On one thread these are processor
/// seconds of this program: what other programs take meanwhile is not in them. On several they
/// are those of the clock.
class Stopwatch {
public:
    explicit Stopwatch(int threads);

    [[nodiscard]] double seconds() const
    {
        return now() - start_;
    }

private:
    [[nodiscard]] double now() const;

    bool one_thread_;
    double start_;
};

}  // namespace packtrace
