int  sample( void ) ;
