/** The tables that three has textures for, RGBA, roughness along a row: M^-1 over its middle element; factors of f0 and of f90 - f0, 0, 0. */
export function ltcTables(): { size: number; matrix: Float32Array; magnitude: Float32Array };
