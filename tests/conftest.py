"""Settings that all tests share."""

import os

from hypothesis import HealthCheck, Phase, settings

# Deadlines measure the machine, not the code. Shrinking a pose of a hundred values takes minutes and tells little.
# On CI the same examples are drawn every time.
settings.register_profile(
    "mien",
    deadline=None,
    max_examples=50,
    phases=(Phase.explicit, Phase.reuse, Phase.generate),
    suppress_health_check=[HealthCheck.too_slow],
    print_blob=True,
)
settings.register_profile("ci", settings.get_profile("mien"), derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "mien")
