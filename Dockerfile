# The simulator in a container, built as everywhere else: by ./dev.
#   docker build -t ambf .
#   docker run --rm --network host ambf -g false
# For real-time scheduling add: --cap-add SYS_NICE --ulimit rtprio=99 --ulimit memlock=-1
FROM debian:12
WORKDIR /opt/ambf
COPY tools/debian-packages.txt tools/python-packages.txt tools/
COPY dev .
RUN ./dev deps && rm -rf /var/lib/apt/lists/*
COPY . .
RUN ./dev build ambf_program
ENTRYPOINT ["build/bin/ambf_simulator"]
