// The constants that all kernels share. A constant is a function: the same in every language.
// Topics: pi, inverse, mask, smallest
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The circle's constant.
real pi() { return 3.14159265358979324; }

// 1 / pi.
real inverse_pi() { return 0.318309886183790672; }

// 1 / (2 pi).
real inverse_two_pi() { return 0.159154943091895336; }

// False in every lane.
mask mask_none() {
    real zero = 0.0;
    return zero > 0.0;
}

// True in every lane.
mask mask_all() { return !mask_none(); }

// Squared lengths are kept above this before a division or an inverse root: the smallest normal float is 1.2e-38, and below it
// GPUs and packs count every number as 0.
real smallest_square() { return 1.0e-36; }

// Lengths are kept above this before a division: the root of smallest_square.
real smallest_length() { return 1.0e-18; }

// Divisors of numbers of the order of 1 are kept above this, so that the quotient may still be multiplied by 1.0e8 within float.
// What is smaller is rounding: a cross product of two unit vectors of float has a square of about 1.0e-14 where they are equal.
real smallest_divisor() { return 1.0e-30; }
