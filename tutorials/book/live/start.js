antilock.start();
