# SPDX-License-Identifier: MIT
"""The table of functions and what Python has of it; documents and types."""

import ast
import ctypes
import doctest
import importlib
import importlib.metadata
import inspect
import pathlib
import pkgutil
import re
import subprocess
import sys
import typing

import cubemap
import cubemap.healpy
import cubemap.large
import cubemap.plot
import numpy as np
import pytest
from cubemap import _core, _library, _method, _methods


MODULES = ("cubemap.healpy", "cubemap.large", "cubemap.plot", *(["cubemap.sim"] * _library.HAS_SIM))


@pytest.fixture(scope="session")
def table(root):
    sys.path.insert(0, str(root / "bindings"))
    import function_table

    return function_table.read(root / "bindings" / "functions")


def found(name):
    at = cubemap
    for part in name.split("."):
        at = inspect.getattr_static(at, part) if inspect.isclass(at) and part in at.__dict__ else getattr(at, part)
    return at


def test_every_name_of_the_table_is_there(table):
    missing = []
    for name in table.by_name("python"):
        if name.startswith("sim.") and not _library.HAS_SIM:
            continue
        try:
            found(name)
        except AttributeError:
            missing.append(name)
    assert not missing


def test_functions_for_many_points_are_those_of_the_table(table):
    names = {function.name for function in table.functions if "python" in function.names}
    assert set(_core.functions) <= names and len(_core.functions) > 60


def test_structs_have_the_sizes_of_the_compiler():
    assert len(_core.sizes) > 30
    for name, size in _core.sizes.items():
        assert ctypes.sizeof(getattr(_library, name)) == size, name


def test_all_that_is_public_says_what_it_is():
    silent = []
    for module in (cubemap, *(importlib.import_module(name) for name in MODULES)):
        for name, value in vars(module).items():
            if name.startswith("_") or not (inspect.isclass(value) or callable(value)):
                continue
            if not str(getattr(value, "__module__", "cubemap")).startswith("cubemap"):
                continue
            if not value.__doc__:
                silent.append(name)
            silent += [f"{name}.{one}" for one, method in (vars(value).items() if inspect.isclass(value) else ())
                       if not one.startswith("_") and not isinstance(method, (tuple, str, int, dict))
                       and type(method).__name__ not in ("_tuplegetter", "member_descriptor") and not method.__doc__]
    assert not silent


def test_types_name_the_methods():
    text = pathlib.Path(cubemap._methods.__file__ + "i").read_text()
    compile(text, "_methods.pyi", "exec")  # which finds names that are there twice, as ast alone does not
    stubs = ast.parse(text)
    classes = {node.name: {item.name for item in node.body} for node in stubs.body if isinstance(node, ast.ClassDef)}
    assert {"forward", "inverse", "forward_jacobian"} <= classes["MappingMethods"]
    for name, methods in classes.items():
        assert methods == {one for one in vars(getattr(cubemap._methods, name)) if not one.startswith("_")}
    # what results are made of is in the types, too
    said = {re.search(r"In C: (\w+),", ast.get_docstring(node))[1]: ast.unparse(node.returns) for node in ast.walk(stubs)
            if isinstance(node, ast.FunctionDef) and ast.get_docstring(node)}
    made = {function: getattr(result, "__annotations__", {}).get("return", result.__name__) for function, result in _method._results.items()}
    assert made.keys() <= said.keys() and {said[function] for function in made} == set(made.values())
    assert all(said[function] == name for function, name in made.items())
    forward = [node for node in ast.walk(stubs) if isinstance(node, ast.FunctionDef) and node.name == "forward"]
    assert ast.unparse(forward[0].returns) == "tuple[int, float, float]" and "NDArray" in ast.unparse(forward[1].returns)
    text = cubemap.Mapping().forward.__doc__
    assert text.startswith("forward(x, y, z, /") and "cm_forward_array" in text and cubemap.Mapping.forward.__doc__ == text


def modules():
    """All that there are, by name, but those that are written by generate.py."""
    yield "cubemap"
    for one in pkgutil.iter_modules(cubemap.__path__, "cubemap."):
        if one.name.split(".")[-1][0] != "_" and (one.name != "cubemap.sim" or _library.HAS_SIM):
            yield one.name
            if one.ispkg:
                inside = importlib.import_module(one.name).__path__
                yield from (part.name for part in pkgutil.iter_modules(inside, f"{one.name}.") if "._" not in part.name)
    yield "cubemap._errors"


@pytest.mark.parametrize("name", modules())
def test_examples_of_docstrings_run(name):
    """Each module has one, and each class that is made by its arguments; they print what stands there."""
    module = importlib.import_module(name)
    found = doctest.DocTestFinder().find(module, name, extraglobs={"cubemap": cubemap, "np": np})
    made = {f"{name}.{one}" for one, value in vars(module).items() if one[0] != "_" and inspect.isclass(value)
            and value.__module__ == name and "__init__" in vars(value)}
    assert {*made, *([name] * ("._" not in name))} <= {one.name for one in found if one.examples}
    runner = doctest.DocTestRunner()
    for one in found:
        runner.run(one)
    assert runner.tries > 0 and runner.failures == 0


def test_helps_are_not_of_pointers():
    """Of C's memory NumPy sees to it; and each says what the function does."""
    for name in _core.functions:
        lines = _method.documents.get(name).split("\n\n")
        assert not re.search(r"may be NULL|must not be NULL|given NULL|overlap|overwrite|alignment|elements each\.|----", _method.documents.get(name)), name
        assert len(lines) > 2 and lines[1].strip() and not lines[1].startswith("In C:"), name


def code_of(path):
    return re.findall(r"```python\n(.*?)```", path.read_text(), re.S)


@pytest.mark.parametrize("page", ["README.md", "bindings/python/README.md", "docs/guide/python.md"])
def test_documents_run_as_printed(root, page, tmp_path, monkeypatch):
    """Each page's code as one program; what blocks of output, or the comments of prints, say is printed is printed."""
    parts = code_of(root / page)
    assert parts
    monkeypatch.chdir(tmp_path)
    program = "import matplotlib\nmatplotlib.use('Agg')\n" + "\n".join(parts).replace('"data/', f'"{root}/data/')
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert ended.returncode == 0, ended.stderr
    shown = [line for block in re.findall(r"```output-of-python\n(.*?)```", (root / page).read_text(), re.S) for line in block.splitlines()]
    shown = shown or re.findall(r"^print\(.*\)  # (.*)$", "\n".join(parts), re.M)
    assert [line.split() for line in ended.stdout.splitlines() if line.strip()][:len(shown)] == [line.split() for line in shown]


def test_the_tutorial_draws(root, tmp_path):
    import matplotlib.pyplot as plt

    ended = subprocess.run([sys.executable, str(root / "bindings/python/tutorial.py"), str(tmp_path)], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    pictures = sorted(path.name for path in tmp_path.glob("*.png"))
    assert pictures == ["cells.png", "distortion.png", "earth.png", "healpix.png", "indicatrices.png"]
    for name in pictures:
        assert plt.imread(tmp_path / name)[..., :3].std() > 0.05, name


def test_the_package_has_its_licence(root):
    try:
        installed = importlib.metadata.distribution("cubemap").files
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("it is no installed package")
    texts = [file.read_text() for file in installed if file.name == "LICENSE"]
    assert texts == [(root / "LICENSE").read_text()]


def test_further_parts_are_there_without_an_import():
    program = "import cubemap, sys; assert 'matplotlib' not in sys.modules; print(cubemap.healpy.nside2npix(4), cubemap.plot.__name__)"
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert ended.stdout.split() == ["192", "cubemap.plot"], ended.stderr
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        cubemap.nothing


def hinted(names, where):
    """Functions and the methods of classes that the package's own files have, without those that begin with _."""
    for name in names:
        one = getattr(where, name)
        if inspect.isfunction(one) and one.__module__.startswith("cubemap."):
            yield f"{where.__name__}.{name}", one
        elif inspect.isclass(one) and one.__module__.startswith("cubemap."):
            for member, value in vars(one).items():
                value = getattr(value, "fget", None) or getattr(value, "__func__", value)
                if inspect.isfunction(value) and value.__module__ == one.__module__ and (member == "__init__" or member[0] != "_"):
                    yield f"{name}.{member}", value


@pytest.mark.parametrize("name", ["cubemap", *(["cubemap.sim"] * _library.HAS_SIM)])
def test_all_names_are_said_to_be_public(name):
    """For checkers of types an imported name is not, unless __all__ says so."""
    module = importlib.import_module(name)
    public = {one for one, value in vars(module).items() if one[0] != "_" and not inspect.ismodule(value)} - {"TYPE_CHECKING"}
    assert sorted(module.__all__) == sorted(public)


def test_checkers_accept_the_documents(root, tmp_path, pytestconfig):
    if not pytestconfig.getoption("--long"):
        pytest.skip("of the long run: it reads NumPy's types for many seconds")
    pages = ["README.md", "bindings/python/README.md", "docs/guide/python.md"]
    for number, page in enumerate(pages):
        (tmp_path / f"page{number}.py").write_text("import numpy as np\n" + "\n".join(code_of(root / page)))
    (tmp_path / "mypy.ini").write_text("[mypy]\nstrict = True\ndisallow_untyped_calls = False\n[mypy-matplotlib.*]\nignore_missing_imports = True\n"
                                       "[mypy-dask.*]\nimplicit_reexport = True\n")
    ended = subprocess.run([sys.executable, "-m", "mypy", "--config-file=mypy.ini", *(f"page{number}.py" for number in range(len(pages)))],
                           capture_output=True, text=True, cwd=tmp_path)
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("where", ["cubemap", *MODULES])
def test_what_is_written_by_hand_has_types(where):
    module = importlib.import_module(where)
    found = dict(hinted([name for name in vars(module) if name[0] != "_"], module))
    assert found
    for name, function in found.items():
        arguments = [one for one in inspect.signature(function).parameters if one not in ("self", "cls")]
        assert set(typing.get_type_hints(function)) == {*arguments, "return"}, name
