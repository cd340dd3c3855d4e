"""The C host of the releases declares the functions of FMI 3.0 as the official headers do, which FMPy has."""

import subprocess
from pathlib import Path

import fmpy

ROOT = Path(__file__).resolve().parents[2]

# The only plain integers of the host's declarations are statuses.
CODE = """
#include "fmi3FunctionTypes.h"
#include <stddef.h>
#define int fmi3Status
#include "fmi3.h"
#undef int
#define SAME(type, name) _Static_assert(__builtin_types_compatible_p(type, fmi3##name##TYPE), #name);
FOR_EACH_FUNCTION(SAME)
SAME(Plain, Terminate)
SAME(FreeInstance, FreeInstance)
SAME(OfStatePlace, GetFMUState)
SAME(OfStatePlace, FreeFMUState)
SAME(SetState, SetFMUState)
SAME(StateSize, SerializedFMUStateSize)
SAME(SerializeState, SerializeFMUState)
SAME(DeserializeState, DeserializeFMUState)
_Static_assert(sizeof(fmi3Status) == sizeof(int) && sizeof(fmi3Boolean) == 1, "sizes");
_Static_assert(WARNING == fmi3Warning && DISCARD == fmi3Discard, "statuses");
"""


def compiled(code, folder):
    """What the compiler says of these declarations."""
    source = folder / "declarations.c"
    source.write_text(code)
    official = Path(fmpy.__file__).parent / "c-code"
    command = ["cc", "-std=c11", "-fsyntax-only", "-I", official, "-I", ROOT / "ci/host", source]
    return subprocess.run(command, capture_output=True, text=True).stderr


def test_the_declarations_are_those_of_the_official_headers(tmp_path):
    assert compiled(CODE, tmp_path) == ""


def test_other_declarations_are_noticed(tmp_path):
    wrong = CODE.replace("SAME(Plain, Terminate)", "SAME(StateSize, Terminate)")
    assert "Terminate" in compiled(wrong, tmp_path)
