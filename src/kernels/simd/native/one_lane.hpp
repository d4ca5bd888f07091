#pragma once

#include <cstddef>
#include <cstdint>

// Packets of one lane: scalars with the interface of xsimd's packets. Kernels compiled with them
// separate what SIMD gains from what the algorithm gains.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class T>
struct OneMask {
    bool value;

    friend OneMask operator&(OneMask a, OneMask b)
    {
        return {a.value && b.value};
    }
    friend OneMask operator|(OneMask a, OneMask b)
    {
        return {a.value || b.value};
    }
    OneMask operator!() const
    {
        return {!value};
    }
    OneMask operator~() const
    {
        return {!value};
    }
};

template <class T>
struct OneLane {
    using value_type = T;
    static constexpr std::size_t size = 1;

    T value;

    OneLane() = default;
    OneLane(T number) : value(number)
    {
    }

    static OneLane load_unaligned(const T* from)
    {
        return *from;
    }
    void store_unaligned(T* to) const
    {
        *to = value;
    }

    friend OneLane operator+(OneLane a, OneLane b)
    {
        return static_cast<T>(a.value + b.value);
    }
    friend OneLane operator-(OneLane a, OneLane b)
    {
        return static_cast<T>(a.value - b.value);
    }
    friend OneLane operator*(OneLane a, OneLane b)
    {
        return static_cast<T>(a.value * b.value);
    }
    friend OneLane operator/(OneLane a, OneLane b)
    {
        return static_cast<T>(a.value / b.value);
    }
    OneLane& operator+=(OneLane b)
    {
        return *this = *this + b;
    }

    friend OneMask<T> operator<(OneLane a, OneLane b)
    {
        return {a.value < b.value};
    }
    friend OneMask<T> operator<=(OneLane a, OneLane b)
    {
        return {a.value <= b.value};
    }
    friend OneMask<T> operator>(OneLane a, OneLane b)
    {
        return {a.value > b.value};
    }
    friend OneMask<T> operator>=(OneLane a, OneLane b)
    {
        return {a.value >= b.value};
    }
    friend OneMask<T> operator==(OneLane a, OneLane b)
    {
        return {a.value == b.value};
    }
    friend OneMask<T> operator!=(OneLane a, OneLane b)
    {
        return {a.value != b.value};
    }

    // Integers only.
    friend OneLane operator&(OneLane a, OneLane b)
    {
        return static_cast<T>(a.value & b.value);
    }
    friend OneLane operator|(OneLane a, OneLane b)
    {
        return static_cast<T>(a.value | b.value);
    }
    friend OneLane operator^(OneLane a, OneLane b)
    {
        return static_cast<T>(a.value ^ b.value);
    }
    friend OneLane operator<<(OneLane a, int places)
    {
        return static_cast<T>(a.value << places);
    }
    friend OneLane operator>>(OneLane a, int places)
    {
        return static_cast<T>(a.value >> places);
    }
};

/// The functions of xsimd, for one lane.
namespace one_lane_operations {

template <class T>
inline OneLane<T> select(OneMask<T> active, OneLane<T> a, OneLane<T> b)
{
    return active.value ? a : b;
}

inline OneLane<float> sqrt(OneLane<float> x)
{
    return __builtin_sqrtf(x.value);
}
inline OneLane<double> sqrt(OneLane<double> x)
{
    return __builtin_sqrt(x.value);
}

inline OneLane<float> abs(OneLane<float> x)
{
    return __builtin_fabsf(x.value);
}
inline OneLane<double> abs(OneLane<double> x)
{
    return __builtin_fabs(x.value);
}

inline OneLane<float> floor(OneLane<float> x)
{
    return __builtin_floorf(x.value);
}
inline OneLane<double> floor(OneLane<double> x)
{
    return __builtin_floor(x.value);
}

}  // namespace one_lane_operations
}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
