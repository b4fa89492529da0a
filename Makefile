# SPDX-License-Identifier: GPL-3.0-or-later
# The front door: `make`, `make demo`, `make test`, `make test-long`, `make clean`. Installs what is missing, then builds in build/.
# CONFIGURE gives CMake more to say: make test CONFIGURE=-DALGEST_WERROR=ON
CONFIGURE ?=
configure = cmake --preset release $(CONFIGURE)
ctest = ctest --test-dir build --output-on-failure --no-tests=error --parallel $$(nproc)

.PHONY: all demo test test-long clean

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
	@$(ctest) $(if $(filter test,$@),--label-exclude long)

clean:
	@rm -rf build
