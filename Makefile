# Everything there is to do with Beeline, in a word each. `make help` lists the words.
# Each installs what it needs and is not there yet (scripts/install_packages.sh), and is quick when
# run again.

PREFIX ?= /usr/local
JOBS   ?= $(shell nproc)
MINUTES ?= 1

export BEELINE_CASES := $(or $(CASES),$(BEELINE_CASES),1)

# A warning fails a run that nobody watches. Sanitizers name functions alone there, which is compiled sooner.
ifdef CI
strict := -DCMAKE_COMPILE_WARNING_AS_ERROR=ON
endif
lines := -DBEELINE_LINE_NUMBERS=$(if $(CI),OFF,ON)

# The Python module, in build/python, for every Python.
module := -DBEELINE_PYTHON=ON -DPython_EXECUTABLE=$(CURDIR)/.venv-python/bin/python

.NOTPARALLEL:
.PHONY: help build demo bench bench-web docs site wheel npm test test-peers test-reasons test-web test-all check web asan asan-all tsan arm fuzz lint prices format portable install clean deb try-deb packages

help:
	@echo "make build     the command, in build/beeline"
	@echo "make demo      an arm moves in straight lines: report and pictures in build/demo"
	@echo "make bench     Beeline beside other solvers on the same poses: tables, build/bench/results.json"
	@echo "make bench-web    the page's functions in WebAssembly beside native ones"
	@echo "make docs      the documentation, in build/docs/html"
	@echo "make site      the page and the documentation as one folder for any static web server, in build/site"
	@echo "make wheel     the Python module with the page for CPython 3.10 to 3.13, in build-wheel/dist, tried in each that is here"
	@echo "make npm       the npm package beeline-arms, in build-npm/dist, tried in Node.js and in a project with Vite"
	@echo "make deb       Debian packages of HEAD, in build-deb/dist: for this system, or SUITES=\"bookworm trixie\", as root, in bare systems"
	@echo "make try-deb   installs them in bare systems, tries them, and removes them; as root"
	@echo "make packages  every package made and tried, and a list of them: make wheel, npm, deb and try-deb"
	@echo "make test      builds and runs every test but the next; CASES=3: with three times the random cases"
	@echo "make test-reasons   the tests in C++ with every sentence of a reason replaced by X: no code and no test reads one"
	@echo "make test-peers   comparisons with Pinocchio, Ruckig, toppra: packages from PyPI; beeline-reach-mpi on OpenMPI"
	@echo "make test-web  the WebAssembly module beside the command, the page in a browser"
	@echo "make test-all  all of these, and make wheel"
	@echo "make web       the page, computed in the browser, in build/web"
	@echo "make check     in minutes, what most often refuses a change; BASE=COMMIT: with the tests of the folders changed since"
	@echo "make asan      tests of readers, inverse kinematics, batches and maps under the address and undefined behaviour sanitizers"
	@echo "make asan-all  all tests under these sanitizers, with a tenth of the cases"
	@echo "make tsan      tests of threads under the thread sanitizer"
	@echo "make arm       the command for 64-bit ARM, in build-arm, its tests under qemu, beside the native command"
	@echo "make fuzz      MINUTES=1: libFuzzer on every reader and on whole answers, so long for each"
	@echo "make portable  what a new user does in bare Debian 12 and 13, and other compilers; as root, takes an hour"
	@echo "make prices    public headers, lines by folder, bytes of what is built"
	@echo "make lint      formatting, static analysis, the house's rules"
	@echo "make format    formats the sources"
	@echo "make install   installs the command and the library; PREFIX=$(PREFIX)"
	@echo "make clean     removes what was built"

build:
	@scripts/install_packages.sh build
	@test -f build/build.ninja || cmake --preset release $(strict)
	@cmake --build --preset release --parallel $(JOBS) --target beeline

demo: build
	@scripts/demo.sh build/beeline build/demo

bench:
	@scripts/install_packages.sh build bench python
	@scripts/bench_peers.sh
	@scripts/venv.sh .venv-python tests/python/requirements.txt
	@cmake --preset release -DBEELINE_BENCH=ON $(module) $(strict)
	@cmake --build --preset release --parallel $(JOBS) --target bench
	@scripts/bench.sh

bench-web: web
	@scripts/install_packages.sh build bench
	@cmake --preset release -DBEELINE_BENCH=ON $(strict) >/dev/null
	@cmake --build --preset release --parallel $(JOBS) --target beeline bench_web
	@PATH="$$(scripts/node_path.sh)" && cd web && BEELINE=$(CURDIR)/build/beeline BENCH_NATIVE=$(CURDIR)/build/bench/bench_web npm run bench --silent

docs:
	@scripts/install_packages.sh build docs python
	@scripts/venv.sh .venv-python tests/python/requirements.txt
	@scripts/venv.sh .venv-docs docs/requirements.txt
	@cmake --preset release $(module) $(strict)
	@cmake --build --preset release --parallel $(JOBS) --target beeline _core
	@scripts/docs.sh build build/docs

site: web docs
	@scripts/site.sh build/web build/docs/html build/site

test:
	@scripts/install_packages.sh build test python
	@scripts/venv.sh .venv-python tests/python/requirements.txt
	@cmake --preset release -DBEELINE_TESTS=ON $(module) $(strict)
	@cmake --build --preset release --parallel $(JOBS)
	@ctest --preset release --parallel $(JOBS) --label-exclude peers

# With every sentence of a reason X. What is built last is the command with its sentences.
test-reasons:
	@scripts/install_packages.sh build test
	@cmake --preset release -DBEELINE_TESTS=ON -DBEELINE_SENTENCES=OFF $(strict) >/dev/null
	@status=0; scripts/test_reasons.sh build $(JOBS) || status=$$?; \
	  cmake --preset release -DBEELINE_SENTENCES=ON >/dev/null && \
	  cmake --build --preset release --parallel $(JOBS) --target beeline && exit $$status

wheel: web
	@scripts/install_packages.sh build python
	@scripts/wheel.sh build-wheel/dist

npm: build web
	@scripts/npm.sh build-web-core/web build-npm/dist
	@scripts/try_npm.sh build-npm/dist

deb:
	@scripts/install_packages.sh build deb
	@JOBS=$(JOBS) scripts/deb.sh build-deb/dist $(SUITES)

try-deb:
	@scripts/install_packages.sh portable
	@scripts/try_deb.sh build-deb/dist $(SUITES)

# The wheel first: it builds the page, which the others carry.
packages:
	@scripts/packages.sh wheel npm deb try-deb

test-peers:
	@scripts/install_packages.sh build test peers python mpi
	@scripts/venv.sh .venv-python tests/python/requirements.txt
	@scripts/venv.sh .venv tests/peers/requirements.txt
	@cmake --preset release -DBEELINE_TESTS=ON -DBEELINE_PEERS=ON -DBEELINE_MPI=ON $(module) $(strict)
	@cmake --build --preset release --parallel $(JOBS) --target peers beeline-reach-mpi
	@ctest --preset release --label-regex peers

test-all: test test-reasons test-peers test-web wheel

# package-lock.json names Node's packages; Node itself is the system's or the one of scripts/node_path.sh.
web:
	@scripts/install_packages.sh build web
	@scripts/web_sources.sh build-web-core/sources
	@cmake --preset web $(strict) -DBEELINE_WEB_QUICK=$(BEELINE_WEB_QUICK) >/dev/null
	@cmake --build --preset web --parallel $(JOBS)
	@scripts/web.sh build-web-core/web build/web

test-web: build web
	@PATH="$$(scripts/node_path.sh)" && cd web && BEELINE=$(CURDIR)/build/beeline npm test --silent

asan asan-all:
	@scripts/install_packages.sh build test python clang
	@scripts/venv.sh .venv-python tests/python/requirements.txt
	@cmake --preset $@ $(module) $(lines)
	@cmake --build --preset $@ --parallel $(JOBS)
	@ctest --preset $@ --parallel $(JOBS)

fuzz:
	@scripts/install_packages.sh build clang
	@cmake --preset fuzz >/dev/null
	@cmake --build --preset fuzz --parallel $(JOBS)
	@scripts/fuzz.sh build-fuzz $(MINUTES) $(JOBS)

tsan:
	@scripts/install_packages.sh build test clang
	@cmake --preset tsan $(lines)
	@cmake --build --preset tsan --parallel $(JOBS)
	@ctest --preset tsan

arm: build
	@scripts/install_packages.sh build test arm
	@scripts/arm_sysroot.sh build-arm/sysroot
	@cmake --preset arm $(strict)
	@cmake --build --preset arm --parallel $(JOBS)
	@ctest --preset arm --parallel $(JOBS)

check:
	@scripts/install_packages.sh build test lint python web
	@scripts/venv.sh .venv-python tests/python/requirements.txt
	@scripts/venv.sh .venv-lint scripts/lint_requirements.txt
	@scripts/web_sources.sh build-web-core/sources
	@cmake --preset release -DBEELINE_TESTS=ON $(module) -DCMAKE_COMPILE_WARNING_AS_ERROR=ON >/dev/null
	@cmake --preset web >/dev/null
	@scripts/check.sh $(BASE)

lint:
	@scripts/install_packages.sh build test lint python mpi
	@scripts/venv.sh .venv-python tests/python/requirements.txt
	@scripts/venv.sh .venv-lint scripts/lint_requirements.txt
	@cmake --preset dev -DBEELINE_MPI=ON $(module) >/dev/null
	@scripts/lint.sh build-dev

format:
	@scripts/install_packages.sh lint
	@scripts/venv.sh .venv-lint scripts/lint_requirements.txt
	@scripts/sources.sh | xargs .venv-lint/bin/clang-format -i

prices:
	@scripts/prices.sh

portable:
	@scripts/install_packages.sh portable
	@scripts/portable.sh

install: build
	@cmake --install build --prefix $(PREFIX)

clean:
	@rm -rf --one-file-system build build-dev build-asan build-asan-all build-tsan build-arm build-fuzz build-bare build-deb build-npm build-wheel build-web-core web/node_modules .venv-bench .venv-docs .venv-lint .venv-node .venv-python .venv-wheel
