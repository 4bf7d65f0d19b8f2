#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes those first inputs of the harnesses that are not text into corpus/, beside this script.

Each function of the modules beside this one packs what the harness of that name takes from its input, in the same order.
The inputs that are text stand in corpus/ as they are.
"""
import pathlib

import core_inputs
import image_inputs
import scene_inputs
import sim_inputs

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"


def main():
    for harness, inputs in {**core_inputs.INPUTS, **scene_inputs.INPUTS, **sim_inputs.INPUTS, **image_inputs.INPUTS}.items():
        folder = CORPUS / harness
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in inputs.items():
            (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
