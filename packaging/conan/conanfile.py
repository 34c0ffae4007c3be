"""Beeline as a package of Conan 2: the command, the library and its CMake files. The libraries that it needs are the
system's (docs/install.md lists them), so no remote is asked: conan create packaging/conan --no-remote -s compiler.cppstd=20"""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain
from conan.tools.files import copy


class Beeline(ConanFile):
    name = "beeline-arms"
    description = "Motion for serial-link robot arms"
    license = "BSD-3-Clause"
    topics = "robotics", "kinematics"
    package_type = "static-library"
    settings = "os", "compiler", "build_type", "arch"

    def set_version(self):
        text = (self._root() / "CMakeLists.txt").read_text()
        self.version = re.search(r"^project\(beeline VERSION ([\d.]+)", text, re.MULTILINE)[1]

    def export_sources(self):
        for folder in ("beeline", "cli", "cmake", "docs", "examples"):
            copy(self, f"{folder}/*", self._root(), self.export_sources_folder)
        for file in ("CMakeLists.txt", "LICENSE", "README.md"):
            copy(self, file, self._root(), self.export_sources_folder)

    def layout(self):
        self.folders.build = "build"
        self.folders.generators = "build/generators"

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        CMakeToolchain(self, generator="Ninja").generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure(variables={"CMAKE_UNITY_BUILD": True})
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, str(Path(self.package_folder) / "licenses"))

    def package_info(self):
        # find_package(beeline) finds beeline's own file, not one of Conan's.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append("lib/cmake/beeline")
        self.cpp_info.includedirs = []
        self.cpp_info.libdirs = []

    def _root(self):
        """The sources beside this recipe."""
        return Path(self.recipe_folder).parent.parent
