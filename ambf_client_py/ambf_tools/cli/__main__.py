"""python -m ambf_tools.cli"""

import sys

from ambf_tools.cli.entry import main

sys.exit(main())
