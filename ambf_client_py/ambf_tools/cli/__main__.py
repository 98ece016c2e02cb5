"""python -m ambf_tools.cli"""

import sys

from ambf_tools.cli.main import main

sys.exit(main())
