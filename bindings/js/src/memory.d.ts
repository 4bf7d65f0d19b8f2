// SPDX-License-Identifier: MIT

/** An array in a module's memory. `array` is a view of it that is good until the memory grows: ask for it anew after a call
 *  that may allocate. */
export class Vector<T> {
    private constructor();
    readonly length: number;
    readonly array: T;
    /** Gives the memory back now; else that happens when nobody has the array. */
    free(): void;
}
