% SPDX-License-Identifier: GPL-3.0-or-later
% The program of the thesis's Appendix 4 (Runge-Kutta 4, vectors along the chain, pow for the force) for a problem of
% precision_stream: octave-cli precision_thesis.m FILE STEP > stream. Only the time steps are timed, not writing them.
words = argv();
problem = load(words{1});
dt = str2double(words{2});
ns = problem(1,1);
early = problem(1,3); stop = problem(1,4);
mass = problem(3:end,1)'; alp = problem(3:end,2)'; d0 = problem(3:end,3)'; f0 = problem(3:end,4)';
kkmax = round(stop/dt);
every = max(1, round(0.4e-6/dt));

u1=zeros(1,ns); pu1=zeros(1,ns);
u=zeros(1,ns); pu=zeros(1,ns);
delta=zeros(1,ns+1);
k1pu=zeros(1,ns); k2pu=zeros(1,ns); k3pu=zeros(1,ns); k4pu=zeros(1,ns);
pu1(1) = problem(1,2);
spent = 0;
clock0 = cputime();

kk = 0;
while (kk < kkmax)
    u=u1; pu=pu1;
    k1u=dt*pu;

    delta(1) = 0;
    delta(2:ns) = max(0,d0(1:(ns-1)) + u(1:(ns-1)) - u(2:ns));
    delta(ns+1) = max(0,d0(ns) + u(ns) - 0);

    k1pu(1) = dt*(-((alp(1))*delta(2)^(3/2)-f0(1))/mass(1));
    k1pu(2:ns) = dt*((alp(1:(ns-1)).*delta(2:ns).^(3/2)-f0(1:(ns-1)))./mass(2:ns) ...
        - (alp(2:ns).*delta(3:(ns+1)).^(3/2)-f0(2:ns))./mass(2:ns));

    au=u+k1u/2;
    apu=pu+k1pu/2;
    k2u=dt*apu;

    delta(1) = 0;
    delta(2:ns) = max(0,d0(1:(ns-1)) + au(1:(ns-1)) - au(2:ns));
    delta(ns+1) = max(0,d0(ns) + au(ns) - 0);

    k2pu(1) = dt*(-((alp(1))*delta(2)^(3/2)-f0(1))/mass(1));
    k2pu(2:ns) = dt*((alp(1:(ns-1)).*delta(2:ns).^(3/2)-f0(1:(ns-1)))./mass(2:ns) ...
        - (alp(2:ns).*delta(3:(ns+1)).^(3/2)-f0(2:ns))./mass(2:ns));

    au=u+k2u/2;
    apu=pu+k2pu/2;
    k3u=dt*apu;

    delta(1) = 0;
    delta(2:ns) = max(0,d0(1:(ns-1)) + au(1:(ns-1)) - au(2:ns));
    delta(ns+1) = max(0,d0(ns) + au(ns) - 0);

    k3pu(1) = dt*(-((alp(1))*delta(2)^(3/2)-f0(1))/mass(1));
    k3pu(2:ns) = dt*((alp(1:(ns-1)).*delta(2:ns).^(3/2)-f0(1:(ns-1)))./mass(2:ns) ...
        - (alp(2:ns).*delta(3:(ns+1)).^(3/2)-f0(2:ns))./mass(2:ns));

    au=u+k3u;
    apu=pu+k3pu;
    k4u=dt*apu;

    delta(1) = 0;
    delta(2:ns) = max(0,d0(1:(ns-1)) + au(1:(ns-1)) - au(2:ns));
    delta(ns+1) = max(0,d0(ns) + au(ns) - 0);

    k4pu(1) = dt*(-((alp(1))*delta(2)^(3/2)-f0(1))/mass(1));
    k4pu(2:ns) = dt*((alp(1:(ns-1)).*delta(2:ns).^(3/2)-f0(1:(ns-1)))./mass(2:ns) ...
        - (alp(2:ns).*delta(3:(ns+1)).^(3/2)-f0(2:ns))./mass(2:ns));

    u1=u+(k1u+2*k2u+2*k3u+k4u)/6;
    pu1=pu+(k1pu+2*k2pu+2*k3pu+k4pu)/6;
    kk=kk+1;

    if (mod(kk,every)==0)
        clock1 = cputime();
        spent = spent + (clock1 - clock0);
        fwrite(stdout, [kk*dt, u1, pu1], "double");
        clock0 = cputime();
    end
end
last = zeros(1, 2*ns+1);
last(1:3) = [-1, spent + (cputime() - clock0), 4*kkmax];
fwrite(stdout, last, "double");
