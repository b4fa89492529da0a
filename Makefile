# SPDX-License-Identifier: GPL-3.0-or-later
# The front door: `make`, `make demo`, `make test`, `make test-long`, `make test-sanitized`, `make fuzz`, `make clean`. Installs what is missing, then
# builds in build/ (sanitized: in build-sanitized/).
# CONFIGURE gives CMake more to say: make test CONFIGURE=-DALGEST_WERROR=ON
CONFIGURE ?=
configure = cmake --preset release $(CONFIGURE)
# Seconds for each fuzz target, and what of the tests runs sanitized, or in test-long: make test-sanitized SANITIZED='-R ^cli/'
FUZZ_SECONDS ?= 1800
SANITIZED ?=
LONG ?=
ctest = ctest --test-dir build --output-on-failure --no-tests=error --parallel $$(nproc)

.PHONY: all demo test test-long test-sanitized fuzz clean

all:
	@.ci/install core
	@$(configure)
	@cmake --build build --target algest

demo: all
	@bash examples/demo/run build/algest

test test-long:
	@.ci/install core test
	@$(configure)
	@cmake --build build
	@$(ctest) $(if $(filter test,$@),--label-exclude long,$(LONG))

sanitized = cmake --preset sanitized $(CONFIGURE) && cmake --build --preset sanitized --target

test-sanitized:
	@.ci/install core test
	@$(sanitized) algest algest_tests
	@ctest --preset sanitized --parallel $$(nproc) $(SANITIZED)

fuzz:
	@.ci/install core test
	@$(sanitized) fuzz_targets
	@tests/fuzz/run build-sanitized $(FUZZ_SECONDS)

clean:
	@rm -rf build build-sanitized
