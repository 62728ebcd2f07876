/** The classic tables of GGX, RGBA, roughness along a row: M^-1 over its middle element; n_A, f_A, 0, clipped sphere. */
export function ltcTables(): { size: number; matrix: Float32Array; magnitude: Float32Array };
