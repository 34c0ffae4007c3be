"""packaging/: the Debian packages ask for what the build needs."""

import re


def names_in(text, field):
    """Names of packages in a field of a control file, one a line."""
    lines = re.search(rf"^{field}:\n((?: .*\n?)+)", text, re.MULTILINE)[1].splitlines()
    return {re.match(r" ([^ ,]+)", line)[1] for line in lines}


def test_the_debian_packages_are_built_with_what_make_build_installs(root):
    control = (root / "packaging" / "debian" / "control").read_text()
    script = (root / "scripts" / "install_packages.sh").read_text()
    build = set(re.search(r"^build=\(([^)]*)\)", script, re.MULTILINE)[1].split())
    # The compiler is Debian's build-essential, and ccache changes no result.
    assert names_in(control, "Build-Depends") == build - {"g++", "ccache"} | {"debhelper-compat"}


def test_the_library_depends_on_every_library_that_its_cmake_package_finds(root):
    control = (root / "packaging" / "debian" / "control").read_text()
    library = control[control.index("Package: libbeeline-dev"):]
    needed = names_in(library, "Depends")
    config = (root / "cmake" / "beeline-config.cmake.in").read_text()
    found = {name.lower() for name in re.findall(r"find_dependency\((\w[\w-]*)", config)}
    assert found
    for name in found:
        assert any(name in package for package in needed), f"{name} in {sorted(needed)}"


def test_the_command_depends_on_what_it_loads_by_name(root):
    control = (root / "packaging" / "debian" / "control").read_text()
    assert "${beeline:Loaded}" in control[:control.index("Package: libbeeline-dev")]
    assert "beeline:Loaded=" in (root / "packaging" / "debian" / "rules").read_text()
