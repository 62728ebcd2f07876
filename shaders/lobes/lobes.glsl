// Names of the lobes that a shader can hold.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#define LOBE_DIFFUSE 0
#define LOBE_LTC 1
#define LOBE_CLOSED_FORM 2
#define LOBE_REPRESENTATIVE_POINT 3
#define LOBE_SHEEN 4
#define LOBE_LTC_CLIPLESS 5
#define LOBE_HALF_VECTOR 6
#define LOBE_TEXTURE_MEANS 7
#define LOBE_PHONG 8
