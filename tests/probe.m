% SPDX-License-Identifier: GPL-3.0-or-later
% Values of datasets as Octave's `load` has them: octave probe.m FILE.h5 DATASET...
% Prints one line each: how many values there are, then some of them. readers.py compares.
arguments = argv ();
% Named parts only: `load` reads no UTF-8, as in a scene, and nothing behind it.
tops = unique (strtok (arguments(2:end), "/"));
data = load (arguments{1}, tops{:});
for k = 2:numel (arguments)
  parts = strsplit (arguments{k}, "/");
  values = data;
  for p = 1:numel (parts)
    values = values.(parts{p});
  endfor
  values = double (values(:));
  printf ("%d", numel (values));
  printf (" %.17g", values(floor ((0:999) * (numel (values) - 1) / 999) + 1));
  printf ("\n");
endfor
