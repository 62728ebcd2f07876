// Numbers of a Phong lobe's methods. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
const int kPhongArvo = 0;
const int kPhongLorentzian = 1;
const int kPhongPearson = 2;
const int kPhongEllipsoid = 3;
const int kPhongSeries = 4;
const int kPhongSeriesHigh = 5;
const int kPhongExact = 6;
